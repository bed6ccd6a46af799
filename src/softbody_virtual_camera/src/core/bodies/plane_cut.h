#pragma once

#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody::virtual_camera {

/// A cut by the plane x = 0 of its frame. The z axis points up.
struct PlaneCut {
  Eigen::Isometry3d T_rest_cut = Eigen::Isometry3d::Identity();
  bool through = true;  ///< if false, the cut is only above z = 0, and its front is at z = 0
};

/// A closed mesh after a cut.
struct CutMesh {
  MeshTopology topology;              ///< of the next revision: the old vertices, then the new ones
  std::vector<int> triangle_parents;  ///< #F: the old triangle that it is part of; -1: it fills the cut
  std::vector<bool> beyond;           ///< #V: on the side with x > 0
};

/// Cuts exactly. Triangles are split along the plane, and the vertices of the cut are doubled. Every closed
/// curve of the section (or of its part above the front) is filled by two faces, so the mesh stays closed. At
/// the front the two faces share their vertices.
/// @throw std::invalid_argument if the plane misses the mesh, is within a micrometre of a vertex, or has
/// nested section curves.
CutMesh cutByPlane(const MeshTopology& before, const PlaneCut& cut);

/// The cut, moved along its normal by less than `reach` to the middle of the widest gap between vertices.
PlaneCut clearOfVertices(const Points& rest, const PlaneCut& cut, double reach);

}  // namespace softbody::virtual_camera
