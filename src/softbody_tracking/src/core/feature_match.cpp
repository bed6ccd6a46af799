#include "feature_match.h"

#include <Eigen/Dense>
#include <algorithm>

#include "pixel_grid.h"

namespace softbody {
namespace {

constexpr double kLargestMotion = 0.1;  // [m] a frame; 3 m/s at 30 Hz
constexpr int kNeighborhoodPx = 40;
constexpr std::size_t kFewestNeighbors = 4;
constexpr std::size_t kFewestForFit = 20;
constexpr int kFits = 1;
constexpr double kRidge = 10.0;               // [px^2]
constexpr double kSmallestSpread = 1e-4;      // [m]
constexpr double kPrecisePx = 2.5;            // across the ray, that no match disagrees too much by
constexpr double kLargestSpread = 3.0;        // times the neighbours' median disagreement
constexpr std::size_t kEnoughNeighbors = 48;  // for a median; of more every second, third, ...

double median(std::vector<double>* values) {
  const auto middle = values->begin() + static_cast<std::ptrdiff_t>(values->size() / 2);
  std::nth_element(values->begin(), middle, values->end());
  return *middle;
}

/// How matches around one place move relative to the prediction: linearly in the image, as a part of a body
/// does that turns and stretches.
struct Neighborhood {
  cv::Point2f center;
  Eigen::Matrix3d motion = Eigen::Matrix3d::Zero();  ///< [m], of (1, right, down) from the centre [px]
  double spread = 0.0;                               ///< median of the disagreements across the ray [m]

  Eigen::Vector3d offset(const cv::Point2f& pixel) const {
    return {1.0, pixel.x - center.x, pixel.y - center.y};
  }
  Eigen::Vector3d typical(const cv::Point2f& pixel) const { return motion * offset(pixel); }
};

class Motions {
 public:
  explicit Motions(const std::vector<FeatureMatch>& matches) : matches_(matches) {
    motions_.reserve(matches.size());
    rays_.reserve(matches.size());
    for (const FeatureMatch& match : matches) {
      motions_.push_back(match.association.measured - match.association.predicted);
      rays_.push_back(match.association.measured.normalized());
    }
  }

  const Eigen::Vector3d& of(int match) const { return motions_[match]; }
  /// Across the ray: the part that the image fixes. Along it depth is less precise.
  double disagreement(int match, const Neighborhood& around) const {
    return (motions_[match] - around.typical(matches_[match].pixel)).cross(rays_[match]).norm();
  }

  Neighborhood neighborhood(const PixelGrid& grid, const cv::Point2f& pixel) {
    std::size_t count = 0;
    grid.around(pixel.x, pixel.y, [&](int) { ++count; });
    const std::size_t step = 1 + count / kEnoughNeighbors;
    neighbors_.clear();
    grid.around(pixel.x, pixel.y, [&](int other) {
      if (count++ % step == 0) neighbors_.push_back(other);
    });
    Neighborhood result;
    result.center = pixel;
    if (neighbors_.size() < kFewestNeighbors) return result;
    for (int k = 0; k < 3; ++k) result.motion(k, 0) = medianOf([&](int other) { return motions_[other][k]; });
    for (int i = 0;; ++i) {
      result.spread = medianOf([&](int other) { return disagreement(other, result); });
      if (i == kFits || neighbors_.size() < kFewestForFit) return result;
      fit(&result);
    }
  }

 private:
  /// Least squares with Cauchy weights.
  void fit(Neighborhood* around) const {
    Eigen::Matrix3d A = Eigen::Matrix3d::Zero(), B = Eigen::Matrix3d::Zero();
    for (int other : neighbors_) {
      const double ratio = disagreement(other, *around) / (around->spread + kSmallestSpread);
      const Eigen::Vector3d offset = around->offset(matches_[other].pixel);
      const Eigen::Vector3d weighted = offset / (1.0 + ratio * ratio);
      A += weighted * offset.transpose();
      B += motions_[other] * weighted.transpose();
    }
    // Neighbours on a line fix nothing across it.
    A(1, 1) += kRidge * A(0, 0), A(2, 2) += kRidge * A(0, 0);
    around->motion = A.ldlt().solve(B.transpose()).transpose();
  }

  template <typename Value>
  double medianOf(const Value& value) {
    values_.clear();
    for (int other : neighbors_) values_.push_back(value(other));
    return median(&values_);
  }

  const std::vector<FeatureMatch>& matches_;
  std::vector<Eigen::Vector3d> motions_, rays_;
  std::vector<int> neighbors_;
  std::vector<double> values_;
};

void markPiece(const Pinhole& camera, double max_disagreement_m, std::uint32_t body, Motions& motions,
               std::vector<FeatureMatch>* matches) {
  PixelGrid grid(camera, kNeighborhoodPx);
  for (std::size_t m = 0; m < matches->size(); ++m) {
    if ((*matches)[m].association.body == body) grid.insert((*matches)[m].pixel, static_cast<int>(m));
  }
  // A cell's matches have the same neighbours.
  for (const std::vector<int>& cell : grid.cells()) {
    if (cell.empty()) continue;
    const Neighborhood around = motions.neighborhood(grid, (*matches)[cell.front()].pixel);
    for (int m : cell) {
      const double pixel_m = (*matches)[m].association.measured.z() / camera.fx;
      const double across = std::max(kPrecisePx * pixel_m, kLargestSpread * around.spread);
      (*matches)[m].inlier =
          motions.of(m).norm() < kLargestMotion &&
          (motions.of(m) - around.typical((*matches)[m].pixel)).norm() < max_disagreement_m &&
          (around.spread == 0.0 || motions.disagreement(m, around) < across);
    }
  }
}

}  // namespace

void markOutliers(const Pinhole& camera, double max_disagreement_m, std::vector<FeatureMatch>* matches) {
  Motions motions(*matches);
  std::uint32_t last = 0;
  for (const FeatureMatch& match : *matches) last = std::max(last, match.association.body);
  for (std::uint32_t body = 0; body <= last; ++body)
    markPiece(camera, max_disagreement_m, body, motions, matches);
}

}  // namespace softbody
