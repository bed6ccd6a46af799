#include "markerless/view_pairs.h"

#include <algorithm>

namespace softbody::scanning {
namespace {

constexpr int kNeighbours[] = {1, 2, 3, 5};
constexpr std::size_t kLoopsPerFrame = 4;
constexpr double kSimilar_rad = 0.35;  // grey levels of a surface look alike within 20 degrees

/// Turn of the axes and of the eyes as seen from the object [rad].
double difference(const Eigen::Isometry3d& T_b_a, double depth_m) {
  return Eigen::AngleAxisd(T_b_a.linear()).angle() + 0.5 * T_b_a.translation().norm() / depth_m;
}

}  // namespace

std::vector<std::pair<int, int>> pairViews(const std::vector<KeyFrame>& frames, double depth_m) {
  std::vector<std::pair<int, int>> pairs;
  const int count = static_cast<int>(frames.size());
  const auto differenceOf = [&](int a, int b) {
    return difference(frames[b].T_camera_model * frames[a].T_camera_model.inverse(), depth_m);
  };
  for (int b = 0; b < count; ++b) {
    for (const int step : kNeighbours)
      if (b >= step && differenceOf(b - step, b) < 1.5 * kSimilar_rad) pairs.emplace_back(b - step, b);
    std::vector<std::pair<double, int>> loops;
    for (int a = 0; a + kLoopFrames < b; ++a) loops.emplace_back(differenceOf(a, b), a);
    std::sort(loops.begin(), loops.end());
    for (std::size_t i = 0; i < std::min(loops.size(), kLoopsPerFrame); ++i)
      if (loops[i].first < 1.5 * kSimilar_rad) pairs.emplace_back(loops[i].second, b);
  }
  return pairs;
}

}  // namespace softbody::scanning
