#pragma once

#include <utility>
#include <vector>

#include "features/orb_extractor.h"

namespace softbody {

/// Of candidates, distance of the descriptor and index of the keypoint, the one that is clearly the nearest:
/// not further than max_distance, and no other but of the same place nearly as near (ratio test, Lowe 2004).
/// @return its index among the candidates, -1 where none is.
int clearlyNearest(const std::vector<std::pair<int, int>>& candidates, const std::vector<Keypoint>& keypoints,
                   int max_distance);

}  // namespace softbody
