#pragma once

#include <filesystem>
#include <string>

namespace softbody {

/// The whole content of a regular file. Folders, pipes and devices are refused, because reading them may
/// never end.
/// @throw std::invalid_argument with the file and the system's reason.
std::string readFile(const std::filesystem::path& path);

/// Whether a path that stands in a file of a user may lead out of this file's folder.
enum class FileScope { kOwnFolder, kAnywhere };

/// True if a file is in the folder or below it, after symbolic links and ".." are resolved.
bool isInside(const std::filesystem::path& file, const std::filesystem::path& folder);

/// The reason for a refusal: which path is outside of which folder, and what to do.
std::string outsideSentence(const std::filesystem::path& file, const std::filesystem::path& folder);

}  // namespace softbody
