#pragma once

#include <cstddef>
#include <vector>

#include "registration/coarse_mesh.h"
#include "registration/found_pose.h"

namespace softbody {

/// Whether the body's centre is within kOtherPlace.
bool inOnePlace(const SearchMeshes& meshes, const PoseHypothesis& a, const PoseHypothesis& b);

/// Whether two poses are in two places, or turned by more than kOtherTurn.
bool differs(const SearchMeshes& meshes, const PoseHypothesis& a, const PoseHypothesis& b);

/// The first poses that differ from those before them.
std::vector<PoseHypothesis> distinct(const SearchMeshes& meshes, const std::vector<PoseHypothesis>& poses,
                                     std::size_t most);

}  // namespace softbody
