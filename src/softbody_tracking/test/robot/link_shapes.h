#pragma once

#include <fmt/format.h>

#include <Eigen/Dense>
#include <string>

#include "softbody_common/geometry/types.h"
#include "softbody_common/statistics/random.h"

namespace softbody {

inline double signedVolume(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const auto& t : mesh.triangles.rowwise()) {
    const Eigen::Vector3d a = mesh.vertices.row(t(0)), b = mesh.vertices.row(t(1)),
                          c = mesh.vertices.row(t(2));
    sum += a.dot(b.cross(c)) / 6.0;
  }
  return sum;
}

/// A URDF with one link; `inside` stands in the link.
inline std::string oneLink(const std::string& inside) {
  return "<robot name=\"arm\"><link name=\"finger\">" + inside + "</link></robot>";
}

inline std::string visual(const std::string& geometry, const std::string& origin = "") {
  return "<visual>" + origin + "<geometry>" + geometry + "</geometry></visual>";
}

inline std::string collision(const std::string& geometry) {
  return "<collision><geometry>" + geometry + "</geometry></collision>";
}

/// A number in [low, high) from a seed and a place in its sequence.
inline double drawn(int seed, int place, double low, double high) {
  return low + (high - low) * unit(hash(static_cast<std::uint64_t>(seed), static_cast<std::uint64_t>(place)));
}

}  // namespace softbody
