#include "tets/cutaway.h"

#include <algorithm>
#include <array>
#include <map>

namespace softbody {
namespace {

/// The faces of a tet of positive volume, outward.
constexpr std::array<std::array<int, 3>, 4> kFaces{{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};

struct Face {
  std::array<int, 3> corners;
  int tet;
};

std::vector<int> keptTets(const TetTopology& topology, const CutawayPlane& plane) {
  const auto coordinates = topology.rest_vertices.col(plane.axis);
  const double low = coordinates.minCoeff(), high = coordinates.maxCoeff();
  const double limit = low + plane.position * (high - low);
  std::vector<int> kept;
  for (int t = 0; t < topology.tets.rows(); ++t) {
    double center = 0.0;
    for (int k = 0; k < 4; ++k) center += 0.25 * coordinates[topology.tets(t, k)];
    if (plane.flip ? center >= limit : center <= limit) kept.push_back(t);
  }
  return kept;
}

}  // namespace

CutawayFaces cutawayFaces(const TetTopology& topology, const CutawayPlane& plane) {
  std::map<std::array<int, 3>, Face> unshared;
  for (const int t : keptTets(topology, plane)) {
    for (const auto& face : kFaces) {
      std::array<int, 3> corners;
      for (int k = 0; k < 3; ++k) corners[k] = topology.tets(t, face[k]);
      std::array<int, 3> key = corners;
      std::sort(key.begin(), key.end());
      if (unshared.erase(key) == 0) unshared[key] = {corners, t};
    }
  }
  CutawayFaces faces;
  faces.triangles.resize(static_cast<Eigen::Index>(unshared.size()), 3);
  for (const auto& [key, face] : unshared) {
    const auto row = static_cast<Eigen::Index>(faces.tets.size());
    for (int k = 0; k < 3; ++k) faces.triangles(row, k) = face.corners[k];
    faces.tets.push_back(face.tet);
  }
  return faces;
}

}  // namespace softbody
