#pragma once

#include <unistd.h>

#include <filesystem>
#include <stdexcept>
#include <string>

#include "softbody_common/files/staged_output.h"

namespace softbody::fuzz {

/// A folder of this process for the files that readers get, in memory where possible.
inline const std::filesystem::path& scratch() {
  struct Folder {
    Folder() {
      const std::filesystem::path memory = "/dev/shm";
      const auto parent = access(memory.c_str(), W_OK) == 0 ? memory : std::filesystem::temp_directory_path();
      std::string name = (parent / "softbody_fuzz_XXXXXX").string();
      if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
      path = name;
    }
    ~Folder() { std::filesystem::remove_all(path); }
    std::filesystem::path path;
  };
  static const Folder folder;
  return folder.path;
}

inline std::string fileWith(const std::string& name, std::string_view bytes) {
  const auto path = scratch() / name;
  writeBytes(path, bytes);
  return path.string();
}

/// Runs a reader. Refusal is what it may throw; the sentence must name the file and say more.
template <typename Refusal, typename Read>
void expectReadOrRefused(const std::string& path, const Read& read) {
  std::string said;
  try {
    read();
    return;
  } catch (const Refusal& refusal) {
    said = refusal.what();
  } catch (const std::exception& other) {
    throw std::logic_error(path + ": not a refusal: " + other.what());
  }
  const std::string folder = std::filesystem::path(path).parent_path().string();
  if (said.find(folder) == std::string::npos || said.size() < path.size() + 5)
    throw std::logic_error("no sentence about " + path + ": " + said);
}

}  // namespace softbody::fuzz
