#pragma once

#include <random>
#include <string>
#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody::test {

/// A defective mesh file.
struct BrokenFile {
  std::string name;  ///< with the format's extension
  std::string bytes;
  std::string sentence;  ///< part of the error message; empty: the mesh is repaired and gives a model
};

/// Typical defects of users' meshes, one file each.
std::vector<BrokenFile> brokenFiles();

/// A small valid mesh in every surface format, also binary, to be mutated.
std::vector<BrokenFile> soundFiles();

/// Flips, removes, duplicates or cuts off a few bytes, or replaces a number.
std::string mutated(std::string bytes, std::mt19937* random);

/// Reads and repairs a file. @return the error message, or nothing. @throw std::runtime_error if the message
/// lacks file or reason, or another exception is thrown.
std::string readOrRefuse(const std::string& path);

}  // namespace softbody::test
