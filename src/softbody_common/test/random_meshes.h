#pragma once

#include <random>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// A regular block of nx * ny * nz cells, six tets each, all of positive volume.
inline TetMesh blockOfTets(int nx, int ny, int nz, double cell) {
  const auto index = [=](int x, int y, int z) { return (x * (ny + 1) + y) * (nz + 1) + z; };
  TetMesh mesh;
  mesh.vertices.resize((nx + 1) * (ny + 1) * (nz + 1), 3);
  for (int x = 0; x <= nx; ++x) {
    for (int y = 0; y <= ny; ++y) {
      for (int z = 0; z <= nz; ++z) mesh.vertices.row(index(x, y, z)) << x * cell, y * cell, z * cell;
    }
  }
  // Kuhn's six: walks from corner 000 to corner 111, one axis at a time; odd permutations have two corners
  // swapped.
  static constexpr int kAxes[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  mesh.tets.resize(6 * nx * ny * nz, 4);
  Eigen::Index t = 0;
  for (int x = 0; x < nx; ++x) {
    for (int y = 0; y < ny; ++y) {
      for (int z = 0; z < nz; ++z) {
        for (int p = 0; p < 6; ++p, ++t) {
          Eigen::Vector3i corner(x, y, z);
          for (int k = 0; k < 4; ++k) {
            mesh.tets(t, k) = index(corner.x(), corner.y(), corner.z());
            if (k < 3) ++corner[kAxes[p][k]];
          }
          if (p >= 3) std::swap(mesh.tets(t, 1), mesh.tets(t, 2));
        }
      }
    }
  }
  return mesh;
}

/// A block whose vertices are shaken by up to `share` of a cell (0.15 keeps every tet's volume positive), the
/// corners of each tet in a random order of the same orientation.
inline TetMesh shakenBlock(int nx, int ny, int nz, double cell, double share, std::mt19937* random) {
  TetMesh mesh = blockOfTets(nx, ny, nz, cell);
  std::uniform_real_distribution<double> shake(-share * cell, share * cell);
  for (Eigen::Index i = 0; i < mesh.vertices.size(); ++i) mesh.vertices.data()[i] += shake(*random);
  for (Eigen::Index t = 0; t < mesh.tets.rows(); ++t) {
    for (int turns = static_cast<int>((*random)() % 12); turns > 0; --turns) {
      const int first = turns % 2;  // a cycle of three corners
      const int kept = mesh.tets(t, first);
      mesh.tets(t, first) = mesh.tets(t, first + 1);
      mesh.tets(t, first + 1) = mesh.tets(t, first + 2);
      mesh.tets(t, first + 2) = kept;
    }
  }
  return mesh;
}

inline Eigen::Vector3d randomPoint(double low, double high, std::mt19937* random) {
  std::uniform_real_distribution<double> coordinate(low, high);
  const double x = coordinate(*random), y = coordinate(*random), z = coordinate(*random);
  return {x, y, z};
}

/// Uniform over rotations; translations within a metre.
inline Eigen::Isometry3d randomMotion(std::mt19937* random) {
  std::normal_distribution<double> normal;
  const double w = normal(*random), x = normal(*random), y = normal(*random), z = normal(*random);
  return Eigen::Translation3d(randomPoint(-1.0, 1.0, random)) * Eigen::Quaterniond(w, x, y, z).normalized();
}

}  // namespace softbody
