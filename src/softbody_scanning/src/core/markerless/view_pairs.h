#pragma once

#include <utility>
#include <vector>

#include "softbody_scanning/key_frames/key_frame.h"

namespace softbody::scanning {

constexpr int kLoopFrames = 10;  // pairs that are further apart in time close a loop

/// Pairs of frames that see the same from similar sides, earlier one first: neighbours in time, and loops.
std::vector<std::pair<int, int>> pairViews(const std::vector<KeyFrame>& frames, double depth_m);

}  // namespace softbody::scanning
