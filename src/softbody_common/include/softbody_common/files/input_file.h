#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace softbody {

/// The whole content of a regular file. Folders, pipes and devices are refused, because reading them may
/// never end.
/// @throw std::invalid_argument with the file and the system's reason.
std::string readFile(const std::filesystem::path& path);

/// The content of a text file as other systems write it: without a byte-order mark, and with '\n' after lines
/// that end with CR or with CR and LF. @throw std::invalid_argument as readFile, and for UTF-16.
std::string readTextFile(const std::filesystem::path& path);

/// The same for bytes that were already read. @param path for messages.
std::string asText(std::string bytes, const std::filesystem::path& path);

/// A line without its comment, which begins with '#' at the start of the line or after a blank. Elsewhere '#'
/// belongs to a name or to a number such as "1.#QNAN".
std::string_view withoutComment(std::string_view line);

/// Whether a path that stands in a file of a user may lead out of this file's folder.
enum class FileScope { kOwnFolder, kAnywhere };

/// @param allow_outside the value of the parameter or option of this name.
constexpr FileScope fileScope(bool allow_outside) {
  return allow_outside ? FileScope::kAnywhere : FileScope::kOwnFolder;
}

/// True if a file is in the folder or below it, after symbolic links and ".." are resolved. An empty path is
/// the current folder.
bool isInside(const std::filesystem::path& file, const std::filesystem::path& folder);

/// The reason for a refusal: which path is outside of which folder, and what to do.
std::string outsideSentence(const std::filesystem::path& file, const std::filesystem::path& folder);

}  // namespace softbody
