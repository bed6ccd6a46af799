#include <cstdint>
#include <cstdlib>

#include "fuzz/feeds.h"

/// libFuzzer's entry. The environment variable FEED names the reader. A fault ends the process by its
/// exception.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  static const softbody::fuzz::Feed& feed = softbody::fuzz::feed(std::getenv("FEED"));
  feed.give({reinterpret_cast<const char*>(bytes), size});
  return 0;
}
