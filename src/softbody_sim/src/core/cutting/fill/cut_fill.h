#pragma once

#include "cutting/patch/patch_facets.h"
#include "cutting/split/split_surface.h"

namespace softbody {

/// The triangulated part of a patch inside a body, with the orientation of the patch. One wall of the cut has
/// these triangles, the other wall the same triangles reversed.
struct CutFill {
  std::vector<Eigen::Vector3d> points;
  TriangleList triangles;
  std::vector<int> facets;  ///< per triangle; -1 after remeshing
  std::vector<int>
      curve;  ///< per half-edge: the half-edge of the surface that the curve follows there; else -1
  std::vector<int>
      mates;  ///< per half-edge: the opposite one; -1 at the curve and where the patch ends inside the body
};

/// Constrained Delaunay triangulation in the plane of each facet. Its points are the vertices of the curve,
/// and the patch's own where it folds or ends inside the body.
/// @param snap_distance: corners of the patch closer than this to a vertex of the curve are moved there [m].
/// @throw CutRefused if the curve does not bound a part of the patch.
CutFill fillWalls(const SplitSurface& surface, const CutCurve& curve, const PatchFacets& facets,
                  double snap_distance);

}  // namespace softbody
