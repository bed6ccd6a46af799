#include "patches/feature_patch.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace softbody {
namespace {

// Most iterations; a patch that is visible converges in fewer.
constexpr int kIterations = 8;
// Last step [px of the level]; the remaining error is smaller than the step.
constexpr float kConverged = 0.1f;
// Standard deviation of the grey values below which a patch shows only noise.
constexpr float kSmallestSpread = 4.0f;
// Smallest eigenvalue of the Hessian of a patch of norm 1 [1/px^2]; below it the patch does not fix its
// position.
constexpr float kWeakestDirection = 0.02f;

using Values = Eigen::Map<Eigen::Array<float, kPatchSize, 1>>;
using ConstValues = Eigen::Map<const Eigen::Array<float, kPatchSize, 1>>;

Values of(PatchSamples* samples) { return Values(samples->values.data()); }
ConstValues of(const PatchSamples& samples) { return ConstValues(samples.values.data()); }

/// @return false if the patch does not fix its position.
bool invertHessian(const PatchTemplate& pattern, Eigen::Matrix2f* inverse) {
  const ConstValues dx = of(pattern.dx), dy = of(pattern.dy);
  Eigen::Matrix2f hessian;
  hessian << (dx * dx).sum(), (dx * dy).sum(), 0.0f, (dy * dy).sum();
  hessian(1, 0) = hessian(0, 1);
  const float half_trace = 0.5f * hessian.trace();
  const float smallest =
      half_trace - std::sqrt(std::max(0.0f, half_trace * half_trace - hessian.determinant()));
  if (smallest < kWeakestDirection) return false;
  *inverse = hessian.inverse();
  return true;
}

/// Whether the warped grid lies in the image, which has one row more than the pairs.
bool fits(const RowPairs& image, const cv::Point2f& center, const Eigen::Matrix2f& warp) {
  constexpr int kHalf = kPatchSide / 2;
  const float reach_u = kHalf * (std::abs(warp(0, 0)) + std::abs(warp(0, 1)));
  const float reach_v = kHalf * (std::abs(warp(1, 0)) + std::abs(warp(1, 1)));
  return center.x - reach_u >= 0.0f && center.y - reach_v >= 0.0f &&
         center.x + reach_u < static_cast<float>(image.cols - 1) &&
         center.y + reach_v < static_cast<float>(image.rows);
}

}  // namespace

bool FeaturePatch::learnLevel(const RowPairs& image, const cv::Point2f& center, Level* level) {
  const Eigen::Matrix2f upright = Eigen::Matrix2f::Identity();
  const cv::Point2f right(1, 0), down(0, 1);
  for (const cv::Point2f& place : {center - right, center + right, center - down, center + down}) {
    if (!fits(image, place, upright)) return false;
  }
  PatchTemplate& pattern = level->pattern;
  samplePatch(image, center, upright, &pattern.values);
  of(&pattern.values) -= of(pattern.values).mean();
  const float norm = of(pattern.values).matrix().norm();
  if (norm < kSmallestSpread * kPatchSide) return false;
  of(&pattern.values) /= norm;
  const auto derive = [&](const cv::Point2f& step, PatchSamples* derivative) {
    PatchSamples before;
    samplePatch(image, center - step, upright, &before);
    samplePatch(image, center + step, upright, derivative);
    of(derivative) = (of(*derivative) - of(before)) / (2.0f * norm);
    of(derivative) -= of(*derivative).mean();
  };
  derive(right, &pattern.dx);
  derive(down, &pattern.dy);
  level->dx_offset = (of(pattern.dx) * of(pattern.values)).sum();
  level->dy_offset = (of(pattern.dy) * of(pattern.values)).sum();
  return invertHessian(pattern, &level->inverse_hessian);
}

bool FeaturePatch::learn(const GrayPyramid& image, const cv::Point2f& pixel) {
  levels_.clear();
  for (int l = 0; l < GrayPyramid::kLevels; ++l) {
    levels_.emplace_back();
    if (learnLevel(image.level(l), image.toLevel(pixel, l), &levels_.back())) continue;
    levels_.pop_back();
    break;
  }
  return !levels_.empty();
}

/// Moves the centre to where the image matches the patch. @return the correlation there; -1 if it fails.
float FeaturePatch::alignLevel(const Level& level, const RowPairs& image, const Eigen::Matrix2f& warp,
                               cv::Point2f* center) {
  float correlation = -1.0f;
  for (int i = 0; i < kIterations; ++i) {
    if (!fits(image, *center, warp)) return -1.0f;
    const PatchSums sums = comparePatch(image, *center, warp, level.pattern);
    if (sums.spread < kSmallestSpread * kPatchSide) return -1.0f;
    correlation = sums.product / sums.spread;
    const Eigen::Vector2f shift =
        level.inverse_hessian * Eigen::Vector2f(sums.along_x / sums.spread - level.dx_offset,
                                                sums.along_y / sums.spread - level.dy_offset);
    const Eigen::Vector2f moved = warp * shift;
    if (!(moved.squaredNorm() < kPatchSide * kPatchSide)) return -1.0f;
    *center -= cv::Point2f(moved.x(), moved.y());
    if (moved.squaredNorm() < kConverged * kConverged) break;
  }
  return correlation;
}

void FeaturePatch::prefetch() const {
  if (levels_.empty()) return;
  const char* level = reinterpret_cast<const char*>(levels_.data());
  for (std::size_t line = 0; line < sizeof(Level); line += alignof(PatchSamples))
    __builtin_prefetch(level + line);
}

FeaturePatch::Alignment FeaturePatch::align(const GrayPyramid& image, const Eigen::Matrix2f& warp,
                                            const cv::Point2f& start, int coarsest_level) const {
  Alignment result{start, -1.0f};
  for (int l = std::min(coarsest_level, static_cast<int>(levels_.size()) - 1); l >= 0; --l) {
    cv::Point2f center = image.toLevel(result.pixel, l);
    result.correlation = alignLevel(levels_[l], image.level(l), warp, &center);
    if (result.correlation > 0.0f) result.pixel = image.toFrame(center, l);
  }
  return result;
}

}  // namespace softbody
