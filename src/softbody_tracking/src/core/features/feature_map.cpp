#include "features/feature_map.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "features/descriptor_match.h"
#include "features/pixel_grid.h"

namespace softbody {
namespace {

constexpr double kVisibleTolerance = 0.01;     // [m], feature behind the rendered surface by more: hidden
constexpr int kFewestDepths = 20;              // of the 25 pixels around a feature: fewer is a depth edge
constexpr float kSmallestCorrelation = 0.75f;  // of a patch that is found again

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

}  // namespace

double featureDepth(const cv::Mat1f& depth, const cv::Point2f& pixel) {
  const cv::Point center = toPixel(pixel);
  if (!cv::Rect(cv::Point(), depth.size()).contains(center)) return 0.0;
  const float middle = depth(center);
  if (middle <= 0.0f) return 0.0;
  const cv::Rect window = cv::Rect(center.x - 2, center.y - 2, 5, 5) & cv::Rect(cv::Point(), depth.size());
  const float most = 0.02f * middle;
  float sum = 0.0f;  // of differences from the middle
  int count = 0;
  for (int v = window.y; v < window.br().y; ++v) {
    const float* row = depth[v];
    for (int u = window.x; u < window.br().x; ++u) {
      const float difference = row[u] - middle;
      const bool agrees = std::abs(difference) <= most;
      sum += agrees ? difference : 0.0f;
      count += agrees ? 1 : 0;
    }
  }
  return count >= kFewestDepths ? middle + static_cast<double>(sum) / count : 0.0;
}

void FeatureMap::predict(const RgbdFrame& frame, const ColorModel& colors, double reach_m,
                         const PredictedSurface& surface) {
  predictions_.clear();
  missed_.clear();
  covered_ = 0;
  for (std::size_t f = 0; f < features_.size(); ++f) {
    Prediction p;
    p.feature = static_cast<int>(f);
    p.position = surface.position(features_[f].place);
    p.body = surface.bodyOf(features_[f].place);
    if (!predictedVisible(surface, p.position, &p.pixel)) continue;
    if (isCovered(frame, colors, p.pixel, p.position.z(), reach_m)) {
      ++covered_;
      continue;
    }
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
    if (i + step < predictions_.size()) features_[predictions_[i + step].feature].patch.prefetch();
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

double FeatureMap::uncoveredShare() const {
  const int shown = expected() + covered_;
  return shown == 0 ? 1.0 : static_cast<double>(expected()) / shown;
}

int FeatureMap::expected(const std::vector<bool>& counted) const {
  return static_cast<int>(std::count_if(predictions_.begin(), predictions_.end(),
                                        [&](const Prediction& p) { return counted[p.body]; }));
}

void FeatureMap::reset() {
  features_.clear();
  predictions_.clear();
  missed_.clear();
  covered_ = 0;
  next_id_ = 0;
}

}  // namespace softbody
