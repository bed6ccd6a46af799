#pragma once

#include <vector>

#include "softbody_common/types.h"

namespace softbody::virtual_camera {

/// A closed mesh cut in two along the plane x = place.
struct PlaneCut {
  MeshTopology topology;     ///< revision 1: the mesh's vertices as they were, then two for each cut edge
  std::vector<bool> beyond;  ///< per vertex: of the piece with x > place
};

/// Cuts exactly: triangles are split where they meet the plane and both pieces are closed by fans around the
/// middle of the section, which must be seen from there (a convex one is).
/// @throw std::invalid_argument if the plane misses the mesh or passes within a micrometre of a vertex.
PlaneCut cutByPlane(const TriangleMesh& mesh, double place);

}  // namespace softbody::virtual_camera
