#pragma once

#include <algorithm>
#include <cstring>
#include <string>
#include <string_view>

namespace softbody::fuzz {

/// Takes values from the front of some bytes; after their end everything is zero or empty.
class ByteSource {
 public:
  explicit ByteSource(std::string_view bytes) : bytes_(bytes) {}

  bool empty() const { return bytes_.empty(); }

  template <typename T>
  T value() {
    T result{};
    const std::size_t size = std::min(sizeof(T), bytes_.size());
    std::memcpy(&result, bytes_.data(), size);
    bytes_.remove_prefix(size);
    return result;
  }

  std::string text(std::size_t length) {
    const std::string result(bytes_.substr(0, length));
    bytes_.remove_prefix(result.size());
    return result;
  }

 private:
  std::string_view bytes_;
};

}  // namespace softbody::fuzz
