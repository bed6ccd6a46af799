#pragma once

#include "cutting/patch/patch_facets.h"
#include "cutting/split/split_surface.h"

namespace softbody {

/// The part of a patch inside a body, triangulated; its triangles face as the patch does. One wall of the cut
/// is made of them, the other of the same triangles turned round.
struct WallFill {
  std::vector<Eigen::Vector3d> points;
  TriangleList triangles;
  std::vector<int> facets;  ///< per triangle
  std::vector<int>
      curve;  ///< per half-edge: the surface's half-edge of the curve that bounds it there; else -1
  std::vector<int>
      mates;  ///< per half-edge: its neighbour's; -1 at the curve and where the patch ends inside the body
};

/// Constrained Delaunay triangulation in the plane of each facet. There are no vertices but the curve's and,
/// where the patch folds or ends inside the body, its own.
/// @param snap_distance: corners of the patch that are nearer to a vertex of the curve lie on it [m].
/// @throw CutRefused if the curve does not bound a part of the patch.
WallFill fillWalls(const SplitSurface& surface, const CutCurve& curve, const PatchFacets& facets,
                   double snap_distance);

}  // namespace softbody
