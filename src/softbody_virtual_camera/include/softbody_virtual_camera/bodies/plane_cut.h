#pragma once

#include <vector>

#include "softbody_common/types.h"

namespace softbody::virtual_camera {

/// A cut by a plane: x = 0 of its frame, whose z axis points up.
struct PlaneCut {
  Eigen::Isometry3d T_rest_cut = Eigen::Isometry3d::Identity();
  bool through = true;  ///< otherwise only above z = 0, its front
};

/// A closed mesh after a cut.
struct CutMesh {
  MeshTopology topology;              ///< revision + 1: the vertices as they were, then the new ones
  std::vector<int> triangle_parents;  ///< #F: the triangle before that it is a part of, -1: fills the cut
  std::vector<bool> beyond;           ///< #V: on the side with x > 0
};

/// Cuts exactly: triangles are split where they meet the plane, what is cut is doubled, and every closed
/// curve of the section, or of its part above the front, becomes two faces. Both keep the mesh closed; at the
/// front they are joined.
/// @throw std::invalid_argument if the plane misses the mesh, passes within a micrometre of a vertex, or
/// meets it in a curve within another one.
CutMesh cutByPlane(const MeshTopology& before, const PlaneCut& cut);

/// The cut moved along its normal by less than `reach`, into the middle of the widest gap between vertices.
PlaneCut clearOfVertices(const Points& rest, const PlaneCut& cut, double reach);

}  // namespace softbody::virtual_camera
