#include "features/expected_features.h"

#include <algorithm>

#include "prediction/depth_evidence.h"

namespace softbody {
namespace {

// A feature further behind the rendered surface than this is hidden by the body itself [m]; the tolerance
// covers the error of interpolation between the visual mesh and the tets.
constexpr double kVisibleTolerance = 0.01;
// Distance [px] of the four pixels around a feature that must show the occluder too: single pixels are noise.
constexpr int kOccluderReachPx = 3;
// How many of these four.
constexpr int kOccluderPixels = 3;

cv::Point2f toPoint2f(const Eigen::Vector2d& p) {
  return {static_cast<float>(p.x()), static_cast<float>(p.y())};
}

cv::Point toPixel(const cv::Point2f& p) { return {cvRound(p.x), cvRound(p.y)}; }

bool predictedVisible(const PredictedSurface& surface, const Eigen::Vector3d& position, cv::Point2f* pixel) {
  if (!(position.z() > 0.0)) return false;
  const Eigen::Vector2d projected = surface.camera().project(position);
  if (!surface.camera().contains(projected.x(), projected.y())) return false;
  *pixel = toPoint2f(projected);
  const float rendered = surface.image().depth(toPixel(*pixel));
  return rendered > 0.0f && position.z() - rendered < kVisibleTolerance;
}

/// Whether an occluder covers a feature: something nearer than the body can be, or something of a foreign
/// colour that is not behind the feature.
bool isOccluded(const RgbdFrame& frame, const ColorModel& colors, const cv::Point2f& pixel, double z,
                double reach) {
  const cv::Rect image(cv::Point(), frame.color.size());
  const cv::Point center = toPixel(pixel);
  const auto nearest = static_cast<float>(z - reach), farthest = static_cast<float>(z + kBehindSurface);
  const auto isForeign = [&](const cv::Point& place) {
    if (!image.contains(place)) return false;
    if (!frame.covered.empty() && frame.covered(place) != 0) return true;
    const float depth = frame.depth(place);
    return depth > 0.0f && (depth < nearest || (depth < farthest && !colors.belongs(frame.color(place))));
  };
  if (!isForeign(center)) return false;
  int foreign = 0;
  for (const cv::Point& offset : {cv::Point(kOccluderReachPx, 0), cv::Point(-kOccluderReachPx, 0),
                                  cv::Point(0, kOccluderReachPx), cv::Point(0, -kOccluderReachPx)}) {
    foreign += isForeign(center + offset) ? 1 : 0;
  }
  return foreign >= kOccluderPixels;
}

}  // namespace

int ExpectedFeatures::countOn(const std::vector<bool>& pieces) const {
  return static_cast<int>(std::count_if(visible.begin(), visible.end(),
                                        [&](const ExpectedFeature& f) { return pieces[f.piece]; }));
}

double ExpectedFeatures::unoccludedShare() const {
  const int all = count() + occluded;
  return all == 0 ? 1.0 : static_cast<double>(count()) / all;
}

ExpectedFeatures expectFeatures(const std::vector<MapFeature>& features, const RgbdFrame& frame,
                                const ColorModel& colors, double reach_m, const PredictedSurface& surface) {
  ExpectedFeatures result;
  for (std::size_t f = 0; f < features.size(); ++f) {
    ExpectedFeature expected;
    expected.feature = static_cast<int>(f);
    expected.position = surface.position(features[f].place);
    expected.piece = surface.pieceOf(features[f].place);
    if (!predictedVisible(surface, expected.position, &expected.pixel)) continue;
    if (isOccluded(frame, colors, expected.pixel, expected.position.z(), reach_m)) {
      ++result.occluded;
      continue;
    }
    expected.warp = surface.imageWarp(features[f].place, features[f].gradient);
    result.visible.push_back(expected);
  }
  return result;
}

ExpectedFeatures lookedForAfter(const RigidMotions& motions, const Pinhole& camera,
                                ExpectedFeatures expected) {
  for (ExpectedFeature& feature : expected.visible) {
    const Eigen::Vector3d moved = motions[feature.piece] * feature.position;
    if (moved.z() > 0.0) feature.pixel = toPoint2f(camera.project(moved));
  }
  return expected;
}

}  // namespace softbody
