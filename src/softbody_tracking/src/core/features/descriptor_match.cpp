#include "features/descriptor_match.h"

#include <algorithm>

namespace softbody {
namespace {

// Largest ratio of the best to the second-best distance; above it the match is ambiguous.
constexpr float kRatio = 0.85f;
// Distance of two keypoints of the same corner [px], found at different scales; these do not compete.
constexpr float kSamePlacePx = 3.0f;

}  // namespace

int clearlyNearest(const std::vector<std::pair<int, int>>& candidates,
                   const std::vector<Keypoint>& keypoints) {
  const auto best = std::min_element(candidates.begin(), candidates.end());
  if (best == candidates.end() || best->first > kMaxHammingDistance) return -1;
  for (const auto& [distance, k] : candidates) {
    if (static_cast<float>(best->first) <= kRatio * static_cast<float>(distance)) continue;
    const cv::Point2f d = keypoints[k].pixel - keypoints[best->second].pixel;
    if (d.dot(d) > kSamePlacePx * kSamePlacePx) return -1;
  }
  return static_cast<int>(best - candidates.begin());
}

}  // namespace softbody
