#pragma once

#include <optional>
#include <string>
#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody::test {

/// A mesh as a person may have it, with what a model of it must be.
struct MutatedMesh {
  std::string base, kind;
  TriangleMesh mesh;
  double unit_m = 1.0;
  /// Of the body [m^3]: known by construction, or counted in voxels for crossing shells. Nothing: the mesh
  /// does not say which body is meant, so it must be refused.
  std::optional<double> volume;
};

/// A closed mesh of one shell.
struct SoundMesh {
  std::string name;
  TriangleMesh mesh;
};

/// A box, an L, a torus and a bumpy ball.
std::vector<SoundMesh> simpleMeshes();

/// Each kind of defect of public bug reports once, at places that the seed decides.
std::vector<MutatedMesh> mutationsOf(const SoundMesh& sound, unsigned seed);

/// The space around which the mesh winds, in a grid of cells along rays [m^3].
double countedVolume(const TriangleMesh& mesh, int cells);

}  // namespace softbody::test
