#include "tracker/frame_matcher.h"

#include <cstring>
#include <iterator>
#include <set>

#include "features/feature_outliers.h"

namespace softbody {
namespace {

constexpr int kBytes = sizeof(Descriptor);
constexpr double kBits = 8.0 * kBytes;

void copyTo(const Descriptor& descriptor, std::size_t row, cv::Mat1b* matrix) {
  std::memcpy(matrix->ptr(static_cast<int>(row)), descriptor.data(), kBytes);
}

/// For each feature the keypoint that is its nearest and whose nearest it is. Other features have none.
std::vector<cv::DMatch> mutuallyNearest(const cv::Mat1b& features, const cv::Mat1b& keypoints) {
  std::vector<cv::DMatch> pairs;
  if (!features.empty() && !keypoints.empty())
    cv::BFMatcher(cv::NORM_HAMMING, true).match(features, keypoints, pairs);
  return pairs;
}

}  // namespace

FeatureMatches FrameMatcher::match(const std::vector<MapFeature>& known, const ExpectedFeatures& expected,
                                   const std::vector<Keypoint>& keypoints, const RgbdFrame& frame) {
  cv::Mat1b before(expected.count(), kBytes), now(static_cast<int>(keypoints.size()), kBytes);
  for (std::size_t i = 0; i < expected.visible.size(); ++i) {
    const MapFeature& feature = known[expected.visible[i].feature];
    copyTo(latest_.emplace(feature.id, feature.descriptor).first->second, i, &before);
  }
  for (std::size_t k = 0; k < keypoints.size(); ++k) copyTo(keypoints[k].descriptor, k, &now);
  FeatureMatches found;
  std::vector<int> taken;  // keypoint of each match
  std::vector<bool> is_found(expected.visible.size());
  for (const cv::DMatch& pair : mutuallyNearest(before, now)) {
    const Keypoint& keypoint = keypoints[pair.trainIdx];
    const double z = featureDepth(frame.depth, keypoint.pixel);
    if (z <= 0.0 || pair.distance > static_cast<float>(config_.max_hamming_distance)) continue;
    const ExpectedFeature& feature = expected.visible[pair.queryIdx];
    is_found[pair.queryIdx] = true;
    FeatureMatch match = matchAt(known[feature.feature], feature, keypoint.pixel, z, frame.camera);
    match.unexplained = pair.distance / kBits;
    match.association.weight = config_.weight;
    found.matches.push_back(match);
    taken.push_back(pair.trainIdx);
  }
  markOutliers(frame.camera, config_.max_disagreement_m, &found.matches);
  for (std::size_t m = 0; m < taken.size(); ++m)
    if (found.matches[m].inlier) latest_[known[found.matches[m].feature].id] = keypoints[taken[m]].descriptor;
  for (std::size_t i = 0; i < is_found.size(); ++i)
    if (!is_found[i]) found.missed.push_back(expected.visible[i]);
  forgetRetired(known);
  return found;
}

void FrameMatcher::forgetRetired(const std::vector<MapFeature>& known) {
  std::set<int> ids;
  for (const MapFeature& feature : known) ids.insert(feature.id);
  for (auto entry = latest_.begin(); entry != latest_.end();)
    entry = ids.count(entry->first) > 0 ? std::next(entry) : latest_.erase(entry);
}

}  // namespace softbody
