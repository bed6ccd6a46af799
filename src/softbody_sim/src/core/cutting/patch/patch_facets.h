#pragma once

#include <array>
#include <vector>

#include "cutting/patch/cut_patch.h"

namespace softbody {

/// An edge of a patch. Its left triangle contains it in the direction from first to second.
struct PatchEdge {
  int first = -1, second = -1;
  int left = -1, right = -1;  ///< triangles; right is -1 on the patch's boundary
  bool fold = true;           ///< boundary of a facet: the faces of the cut keep this edge
};

/// A coordinate frame in a plane.
struct PlaneFrame {
  Eigen::Vector3d origin, x_axis, y_axis;

  Eigen::Vector2d project(const Eigen::Vector3d& point) const {
    return {x_axis.dot(point - origin), y_axis.dot(point - origin)};
  }
};

/// A patch divided into flat facets: neighbouring triangles that lie in one plane. The faces of a cut are
/// triangulated facet by facet, in the plane of the facet, so a patch may bend in any way.
struct PatchFacets {
  CutPatch patch;  ///< with welded vertices, without flat triangles
  std::vector<PatchEdge> edges;
  std::vector<std::array<int, 3>> triangle_edges;  ///< #F: the edge from corner k to corner k + 1
  std::vector<int> facets;                         ///< #F
  std::vector<PlaneFrame> frames;  ///< per facet; x, y and the patch's normal are right-handed
};

/// @param flatness: largest distance of a vertex from the plane of its facet [m].
/// @throw std::invalid_argument if the patch is not an oriented surface with at most two triangles at an
/// edge.
PatchFacets facetsOf(const CutPatch& patch, double flatness);

}  // namespace softbody
