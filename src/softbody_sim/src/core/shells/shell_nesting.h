#pragma once

#include <vector>

#include "shells/shell_list.h"
#include "surface_mesh/surface_repair.h"

namespace softbody {

/// A solid with everything inside it.
struct Body {
  std::vector<Eigen::Index> triangles;
  Eigen::AlignedBox3d box;
  double volume = 0.0;  ///< cavities count as empty
};

/// Flips shells so that solids face outward and cavities inward. @return number of flipped triangles.
std::ptrdiff_t orientShells(WeldedSurface* surface);

/// Replaces groups of crossing shells by their union where that is possible. All shells are closed and face
/// outward. @return number of shells that were united.
int uniteShells(WeldedSurface* surface);

/// The bodies of a surface, largest first. Shells that cross or lie in one another are one body.
std::vector<Body> bodiesOf(const TriangleMesh& mesh);

}  // namespace softbody
