#pragma once

#include <filesystem>
#include <string_view>

namespace softbody {

/// A file that is written under a new name beside its target and then renamed. Without commit() it is
/// removed, and an earlier target stays as it was.
class StagedFile {
 public:
  /// @throw std::runtime_error if the target is no regular file or its folder cannot be written.
  explicit StagedFile(std::filesystem::path target);
  ~StagedFile();
  StagedFile(const StagedFile&) = delete;
  StagedFile& operator=(const StagedFile&) = delete;

  /// Where to write: a new and empty file with the target's extension.
  const std::filesystem::path& path() const { return path_; }
  const std::filesystem::path& target() const { return target_; }

  /// Gives the file its name. @throw std::runtime_error if this fails; the file is then removed.
  void commit();

 private:
  std::filesystem::path target_, path_;
};

/// A new and empty folder beside its target. It is removed at the end, with everything in it.
class StagedFolder {
 public:
  /// @throw std::runtime_error if the folder cannot be made.
  explicit StagedFolder(const std::filesystem::path& target);
  ~StagedFolder();
  StagedFolder(const StagedFolder&) = delete;
  StagedFolder& operator=(const StagedFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

  /// Swaps the folder for the target, or renames it if there is no target. The earlier target is removed at
  /// the end. @throw std::runtime_error if this fails; the target is then as it was.
  void replaceTarget();

 private:
  std::filesystem::path target_, path_;
};

/// Writes a whole file. @throw std::runtime_error with the file and the system's reason.
void writeBytes(const std::filesystem::path& path, std::string_view bytes);

/// Writes a whole file under another name and renames it. @throw std::runtime_error as StagedFile and
/// writeBytes.
void replaceFile(const std::filesystem::path& target, std::string_view bytes);

/// From now on SIGINT, SIGTERM and SIGHUP remove all staged files before they end the process.
void removeStagedFilesOnSignal();

}  // namespace softbody
