#include "texture/view_agreement.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "softbody_common/statistics/median.h"

namespace softbody::scanning {
namespace {

constexpr double kNoise = 5.7;   // of a mean colour, in steps of 255 (the paper's variance of 5e-4)
constexpr double kLimit = 10.2;  // squared distance in standard deviations (the paper's 6e-3)
constexpr int kMostRounds = 10;
constexpr std::size_t kFewest = 3;  // two views can only differ
constexpr std::size_t kForCovariance = 4;

Eigen::Vector3d toVector(const cv::Vec3f& color) { return {color[0], color[1], color[2]}; }

/// Colours that agree: mean and covariance.
struct Agreement {
  Eigen::Vector3d mean;
  Eigen::Matrix3d inverse;

  bool includes(const TriangleView& view) const {
    const Eigen::Vector3d difference = toVector(view.color) - mean;
    return difference.dot(inverse * difference) <= kLimit;
  }
};

Agreement medianAgreement(const std::vector<TriangleView>& views) {
  Agreement start;
  start.inverse.setZero();
  std::vector<double> values(views.size());
  for (int k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < views.size(); ++i) values[i] = views[i].color[k];
    start.mean[k] = medianOf(values);
    for (double& value : values) value = std::abs(value - start.mean[k]);
    const double sigma = medianOf(values) / kMedianPerSigma;
    start.inverse(k, k) = 1.0 / (sigma * sigma + kNoise * kNoise);
  }
  return start;
}

Agreement agreementOf(const std::vector<TriangleView>& views, const std::vector<bool>& inlier) {
  double count = 0.0;
  Agreement result{Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero()};
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (!inlier[i]) continue;
    result.mean += toVector(views[i].color);
    count += 1.0;
  }
  result.mean /= count;
  Eigen::Matrix3d covariance = kNoise * kNoise * Eigen::Matrix3d::Identity();
  for (std::size_t i = 0; i < views.size(); ++i) {
    const Eigen::Vector3d difference = toVector(views[i].color) - result.mean;
    if (inlier[i]) covariance += difference * difference.transpose() / count;
  }
  result.inverse = covariance.inverse();
  return result;
}

std::vector<bool> inliersOf(const std::vector<TriangleView>& views) {
  std::vector<bool> inlier(views.size(), true);
  if (views.size() < kFewest) return inlier;
  const auto decide = [&](const Agreement& agreement) {
    std::vector<bool> next;
    for (const TriangleView& view : views) next.push_back(agreement.includes(view));
    return next;
  };
  std::vector<bool> next = decide(medianAgreement(views));
  for (int round = 0; round < kMostRounds && next != inlier; ++round) {
    const auto count = static_cast<std::size_t>(std::count(next.begin(), next.end(), true));
    if (count == 0) return inlier;
    inlier = next;
    if (count < kForCovariance) break;
    next = decide(agreementOf(views, inlier));
  }
  return inlier;
}

}  // namespace

void removeOutliers(const EdgeNeighbors& neighbors, TriangleViews* views) {
  std::vector<std::vector<int>> outliers(views->size());  // frames
  for (std::size_t t = 0; t < views->size(); ++t) {
    const std::vector<bool> inlier = inliersOf((*views)[t]);
    for (std::size_t i = 0; i < inlier.size(); ++i) {
      if (!inlier[i]) outliers[t].push_back((*views)[t][i].frame);
    }
  }
  for (std::size_t t = 0; t < views->size(); ++t) {
    const auto isOutlierIn = [&](int triangle, const TriangleView& view) {
      if (triangle < 0) return false;
      const std::vector<int>& frames = outliers[static_cast<std::size_t>(triangle)];
      return std::find(frames.begin(), frames.end(), view.frame) != frames.end();
    };
    std::vector<TriangleView> own, clean;
    for (const TriangleView& view : (*views)[t]) {
      if (isOutlierIn(static_cast<int>(t), view)) continue;
      own.push_back(view);
      const bool beside = std::any_of(neighbors[t].begin(), neighbors[t].end(),
                                      [&](int other) { return isOutlierIn(other, view); });
      if (!beside) clean.push_back(view);
    }
    (*views)[t] = clean.empty() ? std::move(own) : std::move(clean);
  }
}

}  // namespace softbody::scanning
