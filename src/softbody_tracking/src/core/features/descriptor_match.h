#pragma once

#include <utility>
#include <vector>

#include "features/orb_extractor.h"

namespace softbody {

/// Largest distance of descriptors of one feature, of 256 bits: those of others differ by about 128.
constexpr int kMaxHammingDistance = 64;

/// The candidate whose descriptor is clearly the nearest: within kMaxHammingDistance, and no candidate at
/// another place is almost as near (ratio test, Lowe 2004). @param candidates distance of the descriptors and
/// index of the keypoint.
/// @return index into the candidates; -1 without one.
int clearlyNearest(const std::vector<std::pair<int, int>>& candidates,
                   const std::vector<Keypoint>& keypoints);

}  // namespace softbody
