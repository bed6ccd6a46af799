#include <Eigen/Dense>
#include <algorithm>

#include "features/feature_map.h"
#include "features/feature_spread.h"
#include "softbody_common/surface_binding.h"
#include "softbody_common/tet_geometry.h"

// How features come to a map, are carried over edits of the body, and go.

namespace softbody {
namespace {

constexpr int kFreeRadiusPx = 7;         // around a known feature no other is admitted
constexpr double kBindTolerance = 0.01;  // [m], surface and depth must agree where a feature is bound
constexpr double kMostGrazing = 0.35;    // cosine of normal and ray where a feature is bound
constexpr int kMostKnown = 4;            // times max_features, with those that are out of view
constexpr int kTrialFrames = 20;
constexpr double kWorstHitRate = 0.2;

/// No other feature is admitted so near.
void erase(const cv::Point2f& pixel, cv::Mat1b* mask) {
  const cv::Point center(cvRound(pixel.x), cvRound(pixel.y));
  const int left = std::max(0, center.x - kFreeRadiusPx),
            right = std::min(mask->cols, center.x + kFreeRadiusPx + 1);
  const int bottom = std::min(mask->rows, center.y + kFreeRadiusPx + 1);
  if (left >= right) return;
  for (int v = std::max(0, center.y - kFreeRadiusPx); v < bottom; ++v)
    std::fill((*mask)[v] + left, (*mask)[v] + right, 0);
}

/// Takes barycentric coordinates in a tet to the rest shape.
Eigen::Matrix4d homogeneousCorners(const TetTopology& volume, int tet) {
  Eigen::Matrix4d corners = Eigen::Matrix4d::Ones();
  for (int k = 0; k < 4; ++k) corners.col(k).head<3>() = volume.rest_vertices.row(volume.tets(tet, k));
  return corners;
}

/// What a pixel shows of the body.
struct SurfacePoint {
  Eigen::Vector3d measured;  ///< camera frame [m]
  int triangle = 0;
  MaterialPoint place;
};

/// Where the surface is seen well, and is the body's. @param shown of each piece.
std::optional<SurfacePoint> surfacePoint(const RgbdFrame& frame, const cv::Point2f& pixel,
                                         const PredictedSurface& surface, const std::vector<bool>& shown) {
  const double z = featureDepth(frame.depth, pixel);
  if (z <= 0.0) return std::nullopt;
  SurfacePoint point;
  point.measured = frame.camera.unproject(pixel.x, pixel.y, z);
  point.triangle = surface.triangleAt(point.measured, kBindTolerance);
  if (point.triangle < 0) return std::nullopt;
  if (-surface.normal(point.triangle).dot(point.measured.normalized()) < kMostGrazing) return std::nullopt;
  point.place = surface.materialPoint(point.triangle, pixel);
  if (!shown[surface.bodyOf(point.place)]) return std::nullopt;
  return point;
}

/// At rest: 3 by #places [m].
Eigen::Matrix3Xf restPositions(const std::vector<MaterialPoint>& places, const TetTopology& volume) {
  Eigen::Matrix3Xf positions(3, places.size());
  for (std::size_t i = 0; i < places.size(); ++i)
    positions.col(i) = positionOf(places[i], volume.rest_vertices, volume.tets).cast<float>();
  return positions;
}

}  // namespace

void FeatureMap::eraseTaken(const std::vector<FeatureMatch>& matches, cv::Mat1b* mask) const {
  for (const FeatureMatch& match : matches) erase(match.pixel, mask);
  for (const Prediction& prediction : missed_) erase(prediction.pixel, mask);
}

int FeatureMap::room() const {
  const int known = static_cast<int>(features_.size());
  return std::max(0, std::min(config_.max_features - expected(), kMostKnown * config_.max_features - known));
}

std::vector<cv::KeyPoint> FeatureMap::choose(const RgbdFrame& frame, const std::vector<cv::KeyPoint>& ranked,
                                             const PredictedSurface& surface, const std::vector<bool>& shown,
                                             int wanted, double gap_m) const {
  std::vector<cv::KeyPoint> corners;
  std::vector<MaterialPoint> places, known;
  for (const cv::KeyPoint& corner : ranked) {
    if (const auto point = surfacePoint(frame, corner.pt, surface, shown)) {
      corners.push_back(corner);
      places.push_back(point->place);
    }
  }
  for (const Prediction& prediction : predictions_) known.push_back(features_[prediction.feature].place);
  std::vector<cv::KeyPoint> chosen;
  const TetTopology& volume = surface.volume();
  const Eigen::Matrix3Xf there = restPositions(places, volume);
  // The first view takes the strong ones first; later ones fill gaps.
  for (const int i : features_.empty() ? spreadStrong(there, wanted, gap_m)
                                       : spreadOut(there, restPositions(known, volume), wanted, gap_m))
    chosen.push_back(corners[i]);
  return chosen;
}

void FeatureMap::admit(const RgbdFrame& frame, const GrayPyramid& image,
                       const std::vector<Keypoint>& keypoints, const PredictedSurface& surface,
                       const std::vector<bool>& shown) {
  int left = room();
  for (const Keypoint& keypoint : keypoints) {
    if (left == 0) break;
    const auto point = surfacePoint(frame, keypoint.pixel, surface, shown);
    MapFeature feature;
    if (!point || !feature.patch.learn(image, keypoint.pixel)) continue;
    feature.id = next_id_++;
    feature.place = point->place;
    feature.gradient = surface.placeGradient(feature.place, point->triangle, keypoint.pixel);
    feature.first = feature;
    feature.first_tet = homogeneousCorners(surface.volume(), feature.place.tet);
    feature.first_vertices = surface.volume().rest_vertices.rows();
    feature.descriptor = keypoint.descriptor;
    feature.reference = frame.T_fixed_camera * point->measured;
    features_.push_back(feature);
    --left;
  }
}

void FeatureMap::retire() {
  const auto hopeless = [](const MapFeature& f) {
    return f.predicted >= kTrialFrames && f.matched < kWorstHitRate * f.predicted;
  };
  features_.erase(std::remove_if(features_.begin(), features_.end(), hopeless), features_.end());
  predictions_.clear();
  missed_.clear();
  covered_ = 0;
}

void FeatureMap::rebind(const TetTopology& before, const TetTopology& after) {
  std::vector<MaterialPoint> places;
  for (const MapFeature& feature : features_) places.push_back(feature.place);
  const std::vector<MaterialPoint> moved = transferPlaces(places, before, after);
  for (std::size_t f = 0; f < features_.size(); ++f) {
    MapFeature& feature = features_[f];
    const int first = feature.first.place.tet;
    if (after.rest_vertices.rows() == feature.first_vertices && first < after.tets.rows() &&
        homogeneousCorners(after, first) == feature.first_tet) {
      static_cast<FeaturePlace&>(feature) = feature.first;
      continue;
    }
    const Eigen::Matrix4d from = homogeneousCorners(before, feature.place.tet),
                          to = homogeneousCorners(after, moved[f].tet);
    if (from != to) feature.gradient = to.inverse() * from * feature.gradient;
    feature.place = moved[f];
  }
}

}  // namespace softbody
