#include "features/expected_features.h"

#include <algorithm>

namespace softbody {
namespace {

// A feature further behind the rendered surface than this is hidden by the body itself [m]; the tolerance
// covers the error of interpolation between the visual mesh and the tets.
constexpr double kVisibleTolerance = 0.01;

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

}  // namespace

int ExpectedFeatures::countOn(const std::vector<bool>& pieces) const {
  return static_cast<int>(std::count_if(visible.begin(), visible.end(),
                                        [&](const ExpectedFeature& f) { return pieces[f.piece]; }));
}

double ExpectedFeatures::unoccludedShare() const {
  const int all = count() + occluded;
  return all == 0 ? 1.0 : static_cast<double>(count()) / all;
}

ExpectedFeatures expectFeatures(const std::vector<MapFeature>& features, const Labels& labels,
                                const PredictedSurface& surface) {
  ExpectedFeatures result;
  for (std::size_t f = 0; f < features.size(); ++f) {
    ExpectedFeature expected;
    expected.feature = static_cast<int>(f);
    expected.position = surface.position(features[f].place);
    expected.piece = surface.pieceOf(features[f].place);
    if (!predictedVisible(surface, expected.position, &expected.pixel)) continue;
    if (labels.at(toPixel(expected.pixel)) == labels::kOccluder) {
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
