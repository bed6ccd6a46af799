#include "softbody_common/files/staged_output.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <random>
#include <stdexcept>

namespace softbody {
namespace {

namespace fs = std::filesystem;

constexpr int kAttempts = 100;  ///< at a name that nobody has

/// Paths for the signal handler, which may not allocate memory.
std::array<std::atomic<char*>, 16> staged_paths;

void remember(const fs::path& path) {
  char* copy = strdup(path.c_str());
  for (auto& slot : staged_paths) {
    char* empty = nullptr;
    if (slot.compare_exchange_strong(empty, copy)) return;
  }
  free(copy);
}

void forget(const fs::path& path) {
  for (auto& slot : staged_paths) {
    char* known = slot.load();
    if (known == nullptr || path != known) continue;
    if (slot.compare_exchange_strong(known, nullptr)) return free(known);
  }
}

void removeAllAndEnd(int signal) {
  for (auto& slot : staged_paths) {
    if (const char* path = slot.load()) unlink(path);
  }
  raise(signal);  // the handler is reset: this ends the process
}

[[noreturn]] void failToWrite(const fs::path& path, int error) {
  throw std::runtime_error(fmt::format("{}: cannot be written: {}", path.string(), std::strerror(error)));
}

/// "DIR/name.part-1a2b3c4d.bag" for "DIR/name.bag".
fs::path otherName(const fs::path& target) {
  static thread_local std::random_device random;
  return target.parent_path() /
         fmt::format("{}.part-{:08x}{}", target.stem().string(), random(), target.extension().string());
}

/// Makes something under a new name beside the target. @param make returns -1 and sets errno if it fails.
template <typename Make>
fs::path makeBeside(const fs::path& target, const Make& make) {
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    fs::path path = otherName(target);
    if (make(path) != -1) return path;
    if (errno != EEXIST) break;
  }
  failToWrite(target, errno);
}

int makeFile(const fs::path& path) {
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  return file == -1 ? -1 : close(file);
}

/// Absolute, and without the trailing slash of "report/".
fs::path folderName(const fs::path& folder) {
  const fs::path name = fs::absolute(folder).lexically_normal();
  return name.has_filename() ? name : name.parent_path();
}

void giveName(const fs::path& from, const fs::path& to) {
  if (::rename(from.c_str(), to.c_str()) != 0) failToWrite(to, errno);
}

bool writeAll(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = write(file, bytes.data(), bytes.size());
    if (count < 0 && errno != EINTR) return false;
    if (count > 0) bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

}  // namespace

StagedFile::StagedFile(fs::path target) : target_(std::move(target)) {
  std::error_code unknown;
  const fs::file_status status = fs::symlink_status(target_, unknown);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    throw std::runtime_error(fmt::format("{}: is {}, not a file that can be replaced; name another file",
                                         target_.string(),
                                         fs::is_directory(status) ? "a folder"
                                         : fs::is_symlink(status) ? "a symbolic link"
                                                                  : "a device or a pipe"));
  }
  path_ = makeBeside(target_, makeFile);
  remember(path_);
}

StagedFile::~StagedFile() {
  if (path_.empty()) return;
  unlink(path_.c_str());
  forget(path_);
}

void StagedFile::commit() {
  giveName(path_, target_);
  forget(path_);
  path_.clear();
}

StagedFolder::StagedFolder(const fs::path& target) : target_(folderName(target)) {
  fs::create_directories(target_.parent_path());
  path_ = makeBeside(target_, [](const fs::path& path) { return mkdir(path.c_str(), 0777); });
}

StagedFolder::~StagedFolder() {
  if (path_.empty()) return;
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

void StagedFolder::replaceTarget() {
  std::error_code unknown;
  if (!fs::exists(fs::symlink_status(target_, unknown))) {
    giveName(path_, target_);
    return path_.clear();
  }
  const StagedFolder earlier(target_);
  giveName(target_, earlier.path_);
  try {
    giveName(path_, target_);
  } catch (...) {
    ::rename(earlier.path_.c_str(), target_.c_str());
    throw;
  }
  path_.clear();
}

void writeBytes(const fs::path& path, std::string_view bytes) {
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file == -1) failToWrite(path, errno);
  const bool written = writeAll(file, bytes);
  const int error = errno;
  if (close(file) != 0 && written) failToWrite(path, errno);
  if (!written) failToWrite(path, error);
}

void replaceFile(const fs::path& target, std::string_view bytes) {
  StagedFile file(target);
  writeBytes(file.path(), bytes);
  file.commit();
}

void removeStagedFilesOnSignal() {
  struct sigaction action {};
  action.sa_handler = removeAllAndEnd;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction now {};
    sigaction(signal, nullptr, &now);
    // A signal that is ignored, as with nohup, stays ignored.
    if (now.sa_handler == SIG_DFL) sigaction(signal, &action, nullptr);
  }
}

}  // namespace softbody
