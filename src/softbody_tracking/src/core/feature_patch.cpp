#include "feature_patch.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace softbody {
namespace {

constexpr int kIterations = 8;
constexpr float kConverged = 0.01f;         // [px of the level]
constexpr float kSmallestSpread = 4.0f;     // grey values: standard deviation below which there is only noise
constexpr float kWeakestDirection = 0.02f;  // eigenvalue of the Hessian of a patch of norm 1 [1/px^2]

}  // namespace

/// Bilinear samples on the warped grid; false where it leaves the image.
bool FeaturePatch::sample(const cv::Mat1b& image, const cv::Point2f& center, const Eigen::Matrix2f& warp,
                          Samples* values) {
  constexpr int kHalf = kSide / 2;
  const float reach_u = kHalf * (std::abs(warp(0, 0)) + std::abs(warp(0, 1)));
  const float reach_v = kHalf * (std::abs(warp(1, 0)) + std::abs(warp(1, 1)));
  const bool inside = center.x - reach_u >= 0.0f && center.y - reach_v >= 0.0f &&
                      center.x + reach_u < static_cast<float>(image.cols - 1) &&
                      center.y + reach_v < static_cast<float>(image.rows - 1);
  if (!inside) return false;
  const auto stride = static_cast<std::ptrdiff_t>(image.step);
  int i = 0;
  for (int y = -kHalf; y <= kHalf; ++y) {
    const auto fy = static_cast<float>(y);
    for (int x = -kHalf; x <= kHalf; ++x, ++i) {
      const auto fx = static_cast<float>(x);
      const float u = center.x + warp(0, 0) * fx + warp(0, 1) * fy;
      const float v = center.y + warp(1, 0) * fx + warp(1, 1) * fy;
      const int u0 = static_cast<int>(u), v0 = static_cast<int>(v);
      const float a = u - static_cast<float>(u0), b = v - static_cast<float>(v0);
      const unsigned char* p = image.data + v0 * stride + u0;
      const float top = static_cast<float>(p[0]) + a * static_cast<float>(p[1] - p[0]);
      const float bottom = static_cast<float>(p[stride]) + a * static_cast<float>(p[stride + 1] - p[stride]);
      (*values)[i] = top + b * (bottom - top);
    }
  }
  return true;
}

/// To mean 0 and norm 1; false for a patch without contrast.
bool FeaturePatch::normalize(Samples* values) {
  *values -= values->mean();
  const float norm = values->matrix().norm();
  if (norm < kSmallestSpread * kSide) return false;
  *values /= norm;
  return true;
}

bool FeaturePatch::learnLevel(const cv::Mat1b& image, const cv::Point2f& center, Level* level) {
  const Eigen::Matrix2f upright = Eigen::Matrix2f::Identity();
  Samples left, right, above, below;
  const bool inside = sample(image, center, upright, &level->values) &&
                      sample(image, center - cv::Point2f(1, 0), upright, &left) &&
                      sample(image, center + cv::Point2f(1, 0), upright, &right) &&
                      sample(image, center - cv::Point2f(0, 1), upright, &above) &&
                      sample(image, center + cv::Point2f(0, 1), upright, &below);
  if (!inside) return false;
  const float norm = (level->values - level->values.mean()).matrix().norm();
  if (!normalize(&level->values)) return false;
  level->dx = (right - left) / (2.0f * norm);
  level->dy = (below - above) / (2.0f * norm);
  Eigen::Matrix2f hessian;
  hessian << (level->dx * level->dx).sum(), (level->dx * level->dy).sum(), 0.0f,
      (level->dy * level->dy).sum();
  hessian(1, 0) = hessian(0, 1);
  const float half_trace = 0.5f * hessian.trace();
  const float smallest =
      half_trace - std::sqrt(std::max(0.0f, half_trace * half_trace - hessian.determinant()));
  if (smallest < kWeakestDirection) return false;
  level->inverse_hessian = hessian.inverse();
  return true;
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

/// Moves the centre until the image there looks like the patch. @return the correlation there.
float FeaturePatch::alignLevel(const Level& level, const cv::Mat1b& image, const Eigen::Matrix2f& warp,
                               cv::Point2f* center) {
  Samples values;
  for (int i = 0; i < kIterations; ++i) {
    if (!sample(image, *center, warp, &values) || !normalize(&values)) return -1.0f;
    const Samples difference = values - level.values;
    const Eigen::Vector2f shift =
        level.inverse_hessian * Eigen::Vector2f((level.dx * difference).sum(), (level.dy * difference).sum());
    const Eigen::Vector2f moved = warp * shift;
    if (!(moved.squaredNorm() < kSide * kSide)) return -1.0f;
    *center -= cv::Point2f(moved.x(), moved.y());
    if (moved.squaredNorm() < kConverged * kConverged) break;
  }
  return (values * level.values).sum();
}

FeaturePatch::Alignment FeaturePatch::align(const GrayPyramid& image, const Eigen::Matrix2f& warp,
                                            const cv::Point2f& start, int coarsest_level) const {
  Alignment result{start, -1.0f};
  for (int l = std::min(coarsest_level, static_cast<int>(levels_.size()) - 1); l >= 0; --l) {
    cv::Point2f center = image.toLevel(result.pixel, l);
    result.correlation = alignLevel(levels_[l], image.level(l), warp, &center);
    if (result.correlation > 0.0f) {
      result.pixel = image.toFrame(center, l);
    } else if (l == 0) {
      result.correlation = -1.0f;
    }
  }
  return result;
}

}  // namespace softbody
