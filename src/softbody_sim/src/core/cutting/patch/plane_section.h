#pragma once

#include <vector>

#include "cutting/patch/cut_patch.h"

namespace softbody {

/// Where a plane passes through some of a body's tets, at rest: of these the ones that it reaches from one
/// tet, face by face. Where it comes to the body's surface it goes on a little.
/// @param normal of the plane, which is the patch's; @param first the tet to start from;
/// @param wanted per tet; @param overhang beyond the surface [m].
CutPatch planeSection(const TetTopology& volume, const Eigen::Vector3d& point, const Eigen::Vector3d& normal,
                      int first, const std::vector<bool>& wanted, double overhang);

}  // namespace softbody
