#pragma once

#include <vector>

#include "cutting/patch/cut_patch.h"

namespace softbody {

/// The section of a plane through tets of a body, at rest. It contains the wanted tets that are connected
/// with the first tet, face by face, along the plane. At the body's surface the section continues by the
/// overhang.
/// @param normal of the plane and of the patch; @param first the tet to start from;
/// @param wanted per tet; @param overhang beyond the surface [m].
CutPatch planeSection(const TetTopology& volume, const Eigen::Vector3d& point, const Eigen::Vector3d& normal,
                      int first, const std::vector<bool>& wanted, double overhang);

}  // namespace softbody
