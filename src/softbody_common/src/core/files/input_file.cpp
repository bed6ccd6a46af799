#include "softbody_common/files/input_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string_view>

namespace softbody {
namespace {

namespace fs = std::filesystem;

/// Closes the file at the end.
struct OpenFile {
  ~OpenFile() {
    if (number != -1) close(number);
  }
  int number;
};

/// Absolute, with links and ".." resolved as far as the system can.
fs::path resolved(const fs::path& path) {
  const fs::path absolute = fs::absolute(path.empty() ? "." : path);  // parent_path() of a bare name is empty
  std::error_code error;
  const fs::path result = fs::weakly_canonical(absolute, error);
  return error ? absolute.lexically_normal() : result;
}

bool startsWith(const std::string& bytes, std::string_view mark) {
  return bytes.compare(0, mark.size(), mark) == 0;
}

[[noreturn]] void failToRead(const fs::path& path, const std::string& reason) {
  throw std::invalid_argument(fmt::format("{}: cannot be read: {}", path.string(), reason));
}

}  // namespace

std::string readFile(const fs::path& path) {
  // Without O_NONBLOCK, opening a pipe waits for a writer.
  const OpenFile file{open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)};
  struct stat status {};
  if (file.number == -1 || fstat(file.number, &status) != 0) failToRead(path, std::strerror(errno));
  if (!S_ISREG(status.st_mode)) failToRead(path, "it is not a regular file");
  std::string bytes;
  bytes.reserve(static_cast<std::size_t>(status.st_size));
  std::array<char, 65536> buffer{};
  for (;;) {
    const ssize_t count = read(file.number, buffer.data(), buffer.size());
    if (count == 0) return bytes;
    if (count < 0 && errno != EINTR) failToRead(path, std::strerror(errno));
    if (count > 0) bytes.append(buffer.data(), static_cast<std::size_t>(count));
  }
}

std::string asText(std::string bytes, const fs::path& path) {
  if (startsWith(bytes, "\xff\xfe") || startsWith(bytes, "\xfe\xff")) {
    throw std::invalid_argument(
        fmt::format("{}: is UTF-16 text; save it as UTF-8 or plain ASCII", path.string()));
  }
  if (startsWith(bytes, "\xef\xbb\xbf")) bytes.erase(0, 3);
  std::size_t kept = 0;
  for (std::size_t k = 0; k < bytes.size(); ++k) {
    const bool ends_line = bytes[k] == '\r';
    if (ends_line && k + 1 < bytes.size() && bytes[k + 1] == '\n') continue;
    bytes[kept++] = ends_line ? '\n' : bytes[k];
  }
  bytes.resize(kept);
  return bytes;
}

std::string readTextFile(const fs::path& path) { return asText(readFile(path), path); }

std::string_view withoutComment(std::string_view line) {
  for (std::size_t k = line.find('#'); k != std::string_view::npos; k = line.find('#', k + 1)) {
    if (k == 0 || line[k - 1] == ' ' || line[k - 1] == '\t') return line.substr(0, k);
  }
  return line;
}

bool isInside(const fs::path& file, const fs::path& folder) {
  const fs::path relative = resolved(file).lexically_relative(resolved(folder));
  return !relative.empty() && *relative.begin() != "..";
}

std::string outsideSentence(const fs::path& file, const fs::path& folder) {
  return fmt::format(
      "{} is outside of the folder {}; move it there, or allow this with --allow-outside (nodes and launch "
      "files: "
      "allow_outside)",
      resolved(file).string(), resolved(folder).string());
}

}  // namespace softbody
