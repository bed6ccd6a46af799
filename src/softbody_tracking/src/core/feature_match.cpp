#include "feature_match.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>

#include "pixel_grid.h"

namespace softbody {
namespace {

constexpr double kLargestMotion = 0.1;  // [m] a frame; 3 m/s at 30 Hz
constexpr int kNeighborhoodPx = 40;
constexpr std::size_t kFewestNeighbors = 4;
constexpr std::size_t kEnoughNeighbors = 100;  // for a median; of more every second, third, ...

double median(std::vector<double>* values) {
  const auto middle = values->begin() + static_cast<std::ptrdiff_t>(values->size() / 2);
  std::nth_element(values->begin(), middle, values->end());
  return *middle;
}

}  // namespace

void markOutliers(const Pinhole& camera, double max_disagreement_m, std::vector<FeatureMatch>* matches) {
  PixelGrid grid(camera, kNeighborhoodPx);
  std::vector<Eigen::Vector3d> motions;
  motions.reserve(matches->size());
  for (const FeatureMatch& match : *matches) {
    grid.insert(match.pixel, static_cast<int>(motions.size()));
    motions.push_back(match.association.measured - match.association.predicted);
  }
  std::array<std::vector<double>, 3> neighbors;
  // A cell's matches have the same neighbours.
  for (const std::vector<int>& cell : grid.cells()) {
    if (cell.empty()) continue;
    for (auto& values : neighbors) values.clear();
    const cv::Point2f pixel = (*matches)[cell.front()].pixel;
    std::size_t count = 0;
    grid.around(pixel.x, pixel.y, [&](int) { ++count; });
    const std::size_t step = 1 + count / kEnoughNeighbors;
    grid.around(pixel.x, pixel.y, [&](int other) {
      if (count++ % step != 0) return;
      for (int k = 0; k < 3; ++k) neighbors[k].push_back(motions[other][k]);
    });
    Eigen::Vector3d typical = Eigen::Vector3d::Zero();
    if (neighbors[0].size() >= kFewestNeighbors)
      typical = {median(&neighbors[0]), median(&neighbors[1]), median(&neighbors[2])};
    for (int m : cell) {
      (*matches)[m].inlier =
          motions[m].norm() < kLargestMotion && (motions[m] - typical).norm() < max_disagreement_m;
    }
  }
}

}  // namespace softbody
