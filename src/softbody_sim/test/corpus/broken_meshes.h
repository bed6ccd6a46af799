#pragma once

#include <random>
#include <string>
#include <vector>

#include "softbody_common/types.h"

namespace softbody::test {

/// The bytes of a mesh file that something is wrong with.
struct BrokenFile {
  std::string name;  ///< with the format's extension
  std::string bytes;
  std::string sentence;  ///< part of the refusal; empty: the mesh is repaired, and a model is made of it
};

/// What users' meshes suffer from, one file each.
std::vector<BrokenFile> brokenFiles();

/// A small sound mesh in every surface format, binary ones too, as a start for mutations.
std::vector<BrokenFile> soundFiles();

/// A few bytes flipped, removed, doubled or cut off, or a number replaced.
std::string mutated(std::string bytes, std::mt19937* random);

/// Reads and repairs a file. @return the refusal, or nothing. @throw std::runtime_error if the refusal says
/// neither file nor reason, or anything but a refusal comes out.
std::string readOrRefuse(const std::string& path);

}  // namespace softbody::test
