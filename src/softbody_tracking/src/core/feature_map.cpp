#include "feature_map.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "descriptor_match.h"
#include "pixel_grid.h"
#include "softbody_common/surface_binding.h"

namespace softbody {
namespace {

constexpr double kVisibleTolerance = 0.01;     // [m], feature behind the rendered surface by more: hidden
constexpr int kFreeRadiusPx = 7;               // around a known feature no other is admitted
constexpr double kBindTolerance = 0.01;        // [m], surface and depth must agree where a feature is bound
constexpr double kMostGrazing = 0.35;          // cosine of normal and ray where a feature is bound
constexpr int kFewestDepths = 20;              // of the 25 pixels around a feature: fewer is a depth edge
constexpr float kSmallestCorrelation = 0.75f;  // of a patch that is found again
constexpr int kTrialFrames = 20;
constexpr double kWorstHitRate = 0.2;

cv::Point2f toPoint2f(const Eigen::Vector2d& p) {
  return {static_cast<float>(p.x()), static_cast<float>(p.y())};
}

cv::Point toPixel(const cv::Point2f& p) { return {cvRound(p.x), cvRound(p.y)}; }

/// The keypoint in the window that matches best, -1 where none does clearly.
int bestKeypoint(const Descriptor& descriptor, const cv::Point2f& predicted,
                 const std::vector<Keypoint>& keypoints, const PixelGrid& grid, int max_hamming_distance,
                 int* distance) {
  constexpr float kRadius2 = kWideSearchPx * kWideSearchPx;
  std::vector<std::pair<int, int>> candidates;  // distance, keypoint
  grid.around(predicted.x, predicted.y, [&](int k) {
    const cv::Point2f d = keypoints[k].pixel - predicted;
    if (d.dot(d) <= kRadius2)
      candidates.emplace_back(hammingDistance(descriptor, keypoints[k].descriptor), k);
  });
  const int best = clearlyNearest(candidates, keypoints, max_hamming_distance);
  if (best < 0) return -1;
  *distance = candidates[best].first;
  return candidates[best].second;
}

bool predictedVisible(const PredictedSurface& surface, const Eigen::Vector3d& position, cv::Point2f* pixel) {
  if (!(position.z() > 0.0)) return false;
  const Eigen::Vector2d projected = surface.camera().project(position);
  if (!surface.camera().contains(projected.x(), projected.y())) return false;
  *pixel = toPoint2f(projected);
  const float rendered = surface.image().depth(toPixel(*pixel));
  return rendered > 0.0f && position.z() - rendered < kVisibleTolerance;
}

/// Whether something nearer than the body can be, or of another colour and not behind it, stands where a
/// feature should be.
bool isCovered(const RgbdFrame& frame, const ColorModel& colors, const cv::Point2f& pixel, double z,
               double reach) {
  constexpr int kReach = 3;  // [px]
  const cv::Rect image(cv::Point(), frame.color.size());
  const cv::Point center = toPixel(pixel);
  const auto nearest = static_cast<float>(z - reach), farthest = static_cast<float>(z + kVisibleTolerance);
  const auto isForeign = [&](const cv::Point& place) {
    if (!image.contains(place)) return false;
    if (!frame.covered.empty() && frame.covered(place) != 0) return true;
    const float depth = frame.depth(place);
    return depth > 0.0f && (depth < nearest || (depth < farthest && !colors.belongs(frame.color(place))));
  };
  if (!isForeign(center)) return false;
  int foreign = 0;
  for (const cv::Point& offset :
       {cv::Point(kReach, 0), cv::Point(-kReach, 0), cv::Point(0, kReach), cv::Point(0, -kReach)}) {
    foreign += isForeign(center + offset) ? 1 : 0;
  }
  return foreign >= 3;
}

/// No other feature is admitted so near.
void erase(const cv::Point2f& pixel, cv::Mat1b* mask) {
  const cv::Point center = toPixel(pixel);
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

}  // namespace

double featureDepth(const cv::Mat1f& depth, const cv::Point2f& pixel) {
  const cv::Point center = toPixel(pixel);
  if (!cv::Rect(cv::Point(), depth.size()).contains(center)) return 0.0;
  const float middle = depth(center);
  if (middle <= 0.0f) return 0.0;
  double sum = 0.0;
  int count = 0;
  const cv::Rect window = cv::Rect(center.x - 2, center.y - 2, 5, 5) & cv::Rect(cv::Point(), depth.size());
  for (int v = window.y; v < window.br().y; ++v) {
    for (int u = window.x; u < window.br().x; ++u) {
      if (std::abs(depth(v, u) - middle) > 0.02f * middle) continue;
      sum += depth(v, u);
      ++count;
    }
  }
  return count >= kFewestDepths ? sum / count : 0.0;
}

void FeatureMap::predict(const RgbdFrame& frame, const ColorModel& colors, double reach_m,
                         const PredictedSurface& surface) {
  predictions_.clear();
  missed_.clear();
  for (std::size_t f = 0; f < features_.size(); ++f) {
    Prediction p;
    p.feature = static_cast<int>(f);
    p.position = surface.position(features_[f].place);
    p.body = surface.bodyOf(features_[f].place);
    if (!predictedVisible(surface, p.position, &p.pixel)) continue;
    if (isCovered(frame, colors, p.pixel, p.position.z(), reach_m)) continue;
    p.warp = surface.imageWarp(features_[f].place, features_[f].gradient);
    predictions_.push_back(p);
  }
}

void FeatureMap::shift(const Pinhole& camera, const RigidMotions& motions) {
  missed_.clear();
  for (Prediction& p : predictions_) {
    p.tried = false;
    const Eigen::Vector3d moved = motions[p.body] * p.position;
    if (moved.z() > 0.0) p.pixel = toPoint2f(camera.project(moved));
  }
}

/// Where the patch is, if it is anywhere around.
std::optional<FeaturePatch::Alignment> FeatureMap::locate(const GrayPyramid& image,
                                                          const Prediction& prediction,
                                                          const cv::Point2f& start, int coarsest_level,
                                                          int radius_px) const {
  const FeaturePatch::Alignment found =
      features_[prediction.feature].patch.align(image, prediction.warp, start, coarsest_level);
  const cv::Point2f moved = found.pixel - prediction.pixel;
  const auto radius = static_cast<float>(radius_px);
  if (found.correlation < kSmallestCorrelation || moved.dot(moved) > radius * radius) return std::nullopt;
  return found;
}

/// Tries full resolution first: that is enough where the prediction is good.
bool FeatureMap::addMatch(const RgbdFrame& frame, const GrayPyramid& image, const Prediction& prediction,
                          const cv::Point2f& start, int radius_px, std::vector<FeatureMatch>* matches) const {
  auto found = locate(image, prediction, start, 0, radius_px);
  if (!found) found = locate(image, prediction, start, GrayPyramid::kLevels - 1, radius_px);
  if (!found) return false;
  const cv::Point2f& pixel = found->pixel;
  const double z = featureDepth(frame.depth, pixel);
  if (z <= 0.0) return false;
  FeatureMatch match;
  match.feature = prediction.feature;
  match.pixel = pixel;
  match.unexplained = 1.0 - found->correlation * found->correlation;
  match.association.kind = TargetKind::kFeature;
  match.association.place = features_[prediction.feature].place;
  match.association.body = prediction.body;
  match.association.predicted = prediction.position;
  match.association.measured = frame.camera.unproject(pixel.x, pixel.y, z);
  match.association.weight = config_.weight;
  matches->push_back(match);
  return true;
}

void FeatureMap::align(const RgbdFrame& frame, const GrayPyramid& image, int wanted,
                       std::vector<FeatureMatch>* matches) {
  matches->reserve(predictions_.size());
  const std::size_t step = 1 + predictions_.size() / static_cast<std::size_t>(wanted);
  for (std::size_t i = 0; i < predictions_.size(); i += step) {
    Prediction& p = predictions_[i];
    if (p.tried) continue;
    p.tried = true;
    if (!addMatch(frame, image, p, p.pixel, config_.search_radius_px, matches)) missed_.push_back(p);
  }
}

void FeatureMap::search(const RgbdFrame& frame, const GrayPyramid& image,
                        const std::vector<Keypoint>& keypoints, const PredictedSurface& surface,
                        std::vector<FeatureMatch>* matches) {
  PixelGrid grid(surface.camera(), kWideSearchPx);
  for (std::size_t k = 0; k < keypoints.size(); ++k) grid.insert(keypoints[k].pixel, static_cast<int>(k));
  std::vector<int> owner(keypoints.size(), -1),
      owner_distance(keypoints.size(), std::numeric_limits<int>::max());
  for (std::size_t m = 0; m < missed_.size(); ++m) {
    int distance = 0;
    const int k = bestKeypoint(features_[missed_[m].feature].descriptor, missed_[m].pixel, keypoints, grid,
                               config_.max_hamming_distance, &distance);
    if (k >= 0 && distance < owner_distance[k]) {
      owner[k] = static_cast<int>(m);
      owner_distance[k] = distance;
    }
  }
  for (std::size_t k = 0; k < keypoints.size(); ++k) {
    if (owner[k] >= 0) addMatch(frame, image, missed_[owner[k]], keypoints[k].pixel, kWideSearchPx, matches);
  }
}

void FeatureMap::credit(const std::vector<FeatureMatch>& matches, const std::vector<bool>& shown) {
  for (const Prediction& prediction : predictions_)
    features_[prediction.feature].predicted += shown[prediction.body] ? 1 : 0;
  for (const FeatureMatch& match : matches)
    features_[match.feature].matched += match.inlier && shown[match.association.body] ? 1 : 0;
}

int FeatureMap::expected(const std::vector<bool>& counted) const {
  return static_cast<int>(std::count_if(predictions_.begin(), predictions_.end(),
                                        [&](const Prediction& p) { return counted[p.body]; }));
}

void FeatureMap::eraseTaken(const std::vector<FeatureMatch>& matches, cv::Mat1b* mask) const {
  for (const FeatureMatch& match : matches) erase(match.pixel, mask);
  for (const Prediction& prediction : missed_) erase(prediction.pixel, mask);
}

void FeatureMap::retire() {
  const auto hopeless = [](const MapFeature& f) {
    return f.predicted >= kTrialFrames && f.matched < kWorstHitRate * f.predicted;
  };
  features_.erase(std::remove_if(features_.begin(), features_.end(), hopeless), features_.end());
  predictions_.clear();
  missed_.clear();
}

void FeatureMap::admit(const RgbdFrame& frame, const GrayPyramid& image,
                       const std::vector<Keypoint>& keypoints, const PredictedSurface& surface,
                       const std::vector<bool>& shown) {
  std::vector<cv::Point2f> taken;
  const auto isFree = [&](const cv::Point2f& pixel) {
    return std::none_of(taken.begin(), taken.end(), [&](const cv::Point2f& other) {
      const cv::Point2f d = other - pixel;
      return d.dot(d) <= kFreeRadiusPx * kFreeRadiusPx;
    });
  };
  const bool first = features_.empty();
  for (const Keypoint& keypoint : keypoints) {
    if (static_cast<int>(features_.size()) >= config_.max_features) break;
    // The reference frame takes every keypoint, like the paper; later ones fill gaps.
    if (!first && !isFree(keypoint.pixel)) continue;
    const double z = featureDepth(frame.depth, keypoint.pixel);
    if (z <= 0.0) continue;
    const Eigen::Vector3d measured = frame.camera.unproject(keypoint.pixel.x, keypoint.pixel.y, z);
    const int triangle = surface.triangleAt(measured, kBindTolerance);
    if (triangle < 0 || -surface.normal(triangle).dot(measured.normalized()) < kMostGrazing) continue;
    MapFeature feature;
    feature.place = surface.materialPoint(triangle, keypoint.pixel);
    if (!shown[surface.bodyOf(feature.place)] || !feature.patch.learn(image, keypoint.pixel)) continue;
    feature.id = next_id_++;
    feature.gradient = surface.placeGradient(feature.place, triangle, keypoint.pixel);
    feature.first = feature;
    feature.first_tet = homogeneousCorners(surface.volume(), feature.place.tet);
    feature.first_vertices = surface.volume().rest_vertices.rows();
    feature.descriptor = keypoint.descriptor;
    feature.reference = frame.T_fixed_camera * measured;
    features_.push_back(feature);
    if (!first) taken.push_back(keypoint.pixel);
  }
  retire();
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

void FeatureMap::reset() {
  features_.clear();
  predictions_.clear();
  missed_.clear();
  next_id_ = 0;
}

}  // namespace softbody
