#include "cutting/binding/tet_walk.h"

#include <algorithm>

#include "cutting/volume/crack_opening.h"
#include "softbody_common/geometry/tet_geometry.h"

namespace softbody {

TetWalk::TetWalk(const Points& vertices, const Tets& tets) : vertices_(vertices), tets_(tets) {
  struct Side {
    Face face;
    int tet, corner;
  };
  std::vector<Side> sides;
  sides.reserve(static_cast<std::size_t>(4 * tets.rows()));
  for (int t = 0; t < static_cast<int>(tets.rows()); ++t) {
    for (int k = 0; k < 4; ++k) sides.push_back({faceOf(tets, t, k), t, k});
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.face < b.face; });
  neighbours_.resize(static_cast<std::size_t>(tets.rows()), {-1, -1, -1, -1});
  for (std::size_t s = 0; s + 1 < sides.size(); ++s) {
    const Side &one = sides[s], &other = sides[s + 1];
    if (one.face != other.face) continue;
    neighbours_[static_cast<std::size_t>(one.tet)][static_cast<std::size_t>(one.corner)] = other.tet;
    neighbours_[static_cast<std::size_t>(other.tet)][static_cast<std::size_t>(other.corner)] = one.tet;
  }
}

/// The neighbour across the face that the point exceeds most; -1 at the boundary.
int TetWalk::nextTet(const MaterialPoint& place, const std::vector<int>& visited) const {
  int next = -1;
  double least = 0.0;
  for (int k = 0; k < 4; ++k) {
    const int tet = neighbours_[static_cast<std::size_t>(place.tet)][static_cast<std::size_t>(k)];
    if (tet < 0 || place.barycentric[k] >= least) continue;
    if (std::find(visited.begin(), visited.end(), tet) != visited.end()) continue;
    least = place.barycentric[k];
    next = tet;
  }
  return next;
}

MaterialPoint TetWalk::towards(int tet, const Eigen::Vector3d& point) const {
  MaterialPoint best;
  std::vector<int> visited;
  while (tet >= 0) {
    const MaterialPoint place{tet, barycentricCoordinates(point, vertices_, tets_.row(tet))};
    const double inside = place.barycentric.minCoeff();
    if (best.tet < 0 || inside > best.barycentric.minCoeff()) best = place;
    if (inside >= 0.0) break;
    visited.push_back(tet);
    tet = nextTet(place, visited);
  }
  return best;
}

}  // namespace softbody
