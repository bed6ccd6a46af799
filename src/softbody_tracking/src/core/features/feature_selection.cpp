#include "features/feature_selection.h"

#include <algorithm>
#include <optional>

#include "features/feature_spread.h"
#include "softbody_common/geometry/tet_geometry.h"

namespace softbody {
namespace {

// Half the side [px] of the square around a known feature in which no other is admitted: their patches would
// overlap.
constexpr int kFreeRadiusPx = 7;
// Surface and depth must agree this well where a feature is bound [m].
constexpr double kBindTolerance = 0.01;
// Smallest cosine between normal and ray where a feature is bound; at grazing angles its place is uncertain.
constexpr double kMostGrazing = 0.35;

void eraseAround(const cv::Point2f& pixel, cv::Mat1b* mask) {
  const cv::Point center(cvRound(pixel.x), cvRound(pixel.y));
  const int left = std::max(0, center.x - kFreeRadiusPx),
            right = std::min(mask->cols, center.x + kFreeRadiusPx + 1);
  const int bottom = std::min(mask->rows, center.y + kFreeRadiusPx + 1);
  if (left >= right) return;
  for (int v = std::max(0, center.y - kFreeRadiusPx); v < bottom; ++v)
    std::fill((*mask)[v] + left, (*mask)[v] + right, 0);
}

/// The point of the body that a pixel shows.
struct SurfacePoint {
  Eigen::Vector3d measured;  ///< camera frame [m]
  int triangle = 0;
  MaterialPoint place;
};

std::optional<SurfacePoint> surfacePoint(const RgbdFrame& frame, const cv::Point2f& pixel,
                                         const PredictedSurface& surface,
                                         const std::vector<bool>& learnable) {
  const double z = featureDepth(frame.depth, pixel);
  if (z <= 0.0) return std::nullopt;
  SurfacePoint point;
  point.measured = frame.camera.unproject(pixel.x, pixel.y, z);
  point.triangle = surface.triangleAt(point.measured, kBindTolerance);
  if (point.triangle < 0) return std::nullopt;
  if (-surface.normal(point.triangle).dot(point.measured.normalized()) < kMostGrazing) return std::nullopt;
  point.place = surface.materialPoint(point.triangle, pixel);
  if (!learnable[surface.pieceOf(point.place)]) return std::nullopt;
  return point;
}

/// Positions at rest, 3 by #places [m].
Eigen::Matrix3Xf restPositions(const std::vector<MaterialPoint>& places, const TetTopology& volume) {
  Eigen::Matrix3Xf positions(3, places.size());
  for (std::size_t i = 0; i < places.size(); ++i)
    positions.col(i) = positionOf(places[i], volume.rest_vertices, volume.tets).cast<float>();
  return positions;
}

}  // namespace

cv::Mat1b withoutKnownFeatures(cv::Mat1b mask, const FeatureMatches& known) {
  for (const FeatureMatch& match : known.matches) eraseAround(match.pixel, &mask);
  for (const ExpectedFeature& missed : known.missed) eraseAround(missed.pixel, &mask);
  return mask;
}

std::vector<cv::KeyPoint> chooseCorners(const RgbdFrame& frame, const std::vector<cv::KeyPoint>& ranked,
                                        const PredictedSurface& surface, const std::vector<bool>& learnable,
                                        const KnownPlaces& known, int wanted, double gap_m) {
  std::vector<cv::KeyPoint> corners;
  std::vector<MaterialPoint> places;
  for (const cv::KeyPoint& corner : ranked) {
    if (const auto point = surfacePoint(frame, corner.pt, surface, learnable)) {
      corners.push_back(corner);
      places.push_back(point->place);
    }
  }
  const TetTopology& volume = surface.volume();
  const Eigen::Matrix3Xf candidates = restPositions(places, volume);
  const std::vector<int> chosen =
      known.first_view ? spreadStrong(candidates, wanted, gap_m)
                       : spreadOut(candidates, restPositions(known.places, volume), wanted, gap_m);
  std::vector<cv::KeyPoint> result;
  result.reserve(chosen.size());
  for (const int i : chosen) result.push_back(corners[i]);
  return result;
}

std::vector<MapFeature> bindKeypoints(const RgbdFrame& frame, const GrayPyramid& image,
                                      const std::vector<Keypoint>& keypoints, const PredictedSurface& surface,
                                      const std::vector<bool>& learnable, int most) {
  std::vector<MapFeature> bound;
  for (const Keypoint& keypoint : keypoints) {
    if (static_cast<int>(bound.size()) == most) break;
    const auto point = surfacePoint(frame, keypoint.pixel, surface, learnable);
    MapFeature feature;
    if (!point || !feature.patch.learn(image, keypoint.pixel)) continue;
    feature.place = point->place;
    feature.gradient = surface.placeGradient(feature.place, point->triangle, keypoint.pixel);
    feature.first = feature;
    feature.first_tet = homogeneousCorners(surface.volume(), feature.place.tet);
    feature.first_vertices = surface.volume().rest_vertices.rows();
    feature.descriptor = keypoint.descriptor;
    feature.reference = frame.T_fixed_camera * point->measured;
    bound.push_back(feature);
  }
  return bound;
}

}  // namespace softbody
