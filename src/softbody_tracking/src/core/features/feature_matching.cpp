#include "features/feature_matching.h"

#include <cmath>
#include <limits>
#include <utility>

#include "features/descriptor_match.h"
#include "features/feature_weights.h"
#include "features/pixel_grid.h"

namespace softbody {
namespace {

// Of the 25 pixels around a feature, this many must have about the same depth; with fewer it lies on a depth
// edge.
constexpr int kFewestDepths = 20;
// Depth difference of these pixels, as a share of the depth: a slanted surface, but no edge.
constexpr float kSameDepth = 0.02f;
// Normalised correlation below which a patch counts as not found; unrelated texture seldom reaches it.
constexpr float kSmallestCorrelation = 0.75f;

/// The keypoint in the window with clearly the best descriptor. @return its index and distance; empty without
/// one.
std::optional<std::pair<int, int>> bestKeypoint(const Descriptor& descriptor, const cv::Point2f& expected,
                                                const std::vector<Keypoint>& keypoints,
                                                const PixelGrid& grid) {
  constexpr float kRadius2 = kWideSearchPx * kWideSearchPx;
  std::vector<std::pair<int, int>> candidates;  // distance, keypoint
  grid.around(expected.x, expected.y, [&](int k) {
    const cv::Point2f d = keypoints[k].pixel - expected;
    if (d.dot(d) <= kRadius2)
      candidates.emplace_back(hammingDistance(descriptor, keypoints[k].descriptor), k);
  });
  const int best = clearlyNearest(candidates, keypoints);
  if (best < 0) return std::nullopt;
  return std::make_pair(candidates[best].second, candidates[best].first);
}

/// Every how many features one is aligned to get about the wanted number.
std::size_t stepFor(const ExpectedFeatures& expected, int wanted) {
  return 1 + expected.visible.size() / static_cast<std::size_t>(wanted);
}

}  // namespace

double featureDepth(const cv::Mat1f& depth, const cv::Point2f& pixel) {
  const cv::Point center(cvRound(pixel.x), cvRound(pixel.y));
  if (!cv::Rect(cv::Point(), depth.size()).contains(center)) return 0.0;
  const float middle = depth(center);
  if (!(middle > 0.0f)) return 0.0;
  const cv::Rect window = cv::Rect(center.x - 2, center.y - 2, 5, 5) & cv::Rect(cv::Point(), depth.size());
  const float most = kSameDepth * middle;
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

FeatureMatch matchAt(const MapFeature& feature, const ExpectedFeature& expected, const cv::Point2f& pixel,
                     double depth, const Pinhole& camera) {
  FeatureMatch match;
  match.feature = expected.feature;
  match.pixel = pixel;
  match.association.kind = TargetKind::kFeature;
  match.association.place = feature.place;
  match.association.piece = expected.piece;
  match.association.predicted = expected.position;
  match.association.measured = camera.unproject(pixel.x, pixel.y, depth);
  return match;
}

FeatureMatches FeatureMatcher::alignAll(const ExpectedFeatures& expected) const {
  return alignSome(expected, std::numeric_limits<int>::max());
}

FeatureMatches FeatureMatcher::alignSome(const ExpectedFeatures& expected, int wanted) const {
  FeatureMatches found;
  found.matches.reserve(expected.visible.size());
  const std::size_t step = stepFor(expected, wanted);
  for (std::size_t i = 0; i < expected.visible.size(); i += step) {
    if (i + step < expected.visible.size()) features_[expected.visible[i + step].feature].patch.prefetch();
    alignOne(expected.visible[i], &found);
  }
  return found;
}

FeatureMatches FeatureMatcher::alignOthers(const ExpectedFeatures& expected, int wanted,
                                           FeatureMatches found) const {
  const std::size_t step = stepFor(expected, wanted);
  for (std::size_t i = 0; i < expected.visible.size(); ++i) {
    if (i % step == 0) continue;
    if (i + 1 < expected.visible.size()) features_[expected.visible[i + 1].feature].patch.prefetch();
    alignOne(expected.visible[i], &found);
  }
  return found;
}

void FeatureMatcher::alignOne(const ExpectedFeature& expected, FeatureMatches* found) const {
  if (const auto found_here = match(expected, expected.pixel, kSearchRadius_px))
    found->matches.push_back(*found_here);
  else
    found->missed.push_back(expected);
}

/// The patch near a start, if the image shows it there.
std::optional<FeaturePatch::Alignment> FeatureMatcher::alignPatch(const ExpectedFeature& expected,
                                                                  const cv::Point2f& start,
                                                                  int coarsest_level, int radius_px) const {
  const FeaturePatch::Alignment found =
      features_[expected.feature].patch.align(image_, expected.warp, start, coarsest_level);
  const cv::Point2f moved = found.pixel - expected.pixel;
  const auto radius = static_cast<float>(radius_px);
  if (found.correlation < kSmallestCorrelation || moved.dot(moved) > radius * radius) return std::nullopt;
  return found;
}

/// Tries full resolution first: this is enough for a good prediction.
std::optional<FeatureMatch> FeatureMatcher::match(const ExpectedFeature& expected, const cv::Point2f& start,
                                                  int radius_px) const {
  auto found = alignPatch(expected, start, 0, radius_px);
  if (!found) found = alignPatch(expected, start, GrayPyramid::kLevels - 1, radius_px);
  if (!found) return std::nullopt;
  const cv::Point2f& pixel = found->pixel;
  const double z = featureDepth(frame_.depth, pixel);
  if (z <= 0.0) return std::nullopt;
  FeatureMatch match = matchAt(features_[expected.feature], expected, pixel, z, frame_.camera);
  match.unexplained = 1.0 - found->correlation * found->correlation;
  match.association.weight = kFeatureWeight * trustIn(features_[expected.feature]);
  return match;
}

std::vector<FeatureMatch> FeatureMatcher::matchDescriptors(const std::vector<ExpectedFeature>& missed,
                                                           const std::vector<Keypoint>& keypoints) const {
  PixelGrid grid(frame_.camera, kWideSearchPx);
  for (std::size_t k = 0; k < keypoints.size(); ++k) grid.insert(keypoints[k].pixel, static_cast<int>(k));
  std::vector<int> owner(keypoints.size(), -1),
      owner_distance(keypoints.size(), std::numeric_limits<int>::max());
  for (std::size_t m = 0; m < missed.size(); ++m) {
    const auto best = bestKeypoint(features_[missed[m].feature].descriptor, missed[m].pixel, keypoints, grid);
    if (!best) continue;
    const auto& [k, distance] = *best;
    if (distance >= owner_distance[k]) continue;
    owner[k] = static_cast<int>(m);
    owner_distance[k] = distance;
  }
  std::vector<FeatureMatch> matches;
  for (std::size_t k = 0; k < keypoints.size(); ++k) {
    if (owner[k] < 0) continue;
    if (const auto found = match(missed[owner[k]], keypoints[k].pixel, kWideSearchPx))
      matches.push_back(*found);
  }
  return matches;
}

}  // namespace softbody
