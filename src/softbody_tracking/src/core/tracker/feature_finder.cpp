#include "tracker/feature_finder.h"

#include <algorithm>
#include <utility>

#include "alignment/piece_visibility.h"
#include "features/feature_outliers.h"

namespace softbody {
namespace {

// Pixels around the searched region that descriptors and patches need.
constexpr int kPatchMargin = 32;
// Features that are aligned first, to see whether the prediction is far off.
constexpr int kScouts = 48;
// Distance from the expected pixel [px] that full resolution can hardly align.
constexpr double kFarOff = 4.0;

/// The rendered body with a margin for features at this distance from their expected pixels.
cv::Rect searchRegion(const PredictedSurface& surface, const cv::Size& size, int reach_px) {
  const int margin = reach_px + kPatchMargin;
  const cv::Rect& covered = surface.image().region;
  if (covered.empty()) return {};
  return cv::Rect(covered.x - margin, covered.y - margin, covered.width + 2 * margin,
                  covered.height + 2 * margin) &
         cv::Rect(cv::Point(), size);
}

}  // namespace

FoundFeatures FeatureFinder::expect(const SoughtFeatures& sought, const PredictedSurface& surface,
                                    const Labels& labels) const {
  const cv::Mat3b& color = sought.frame.color;
  FoundFeatures features;
  features.expected = expectFeatures(sought.known, labels, surface);
  features.image = GrayPyramid(color, searchRegion(surface, color.size(), kSearchRadius_px));
  return features;
}

FoundFeatures FeatureFinder::findAll(const SoughtFeatures& sought, FoundFeatures expected) const {
  const FeatureMatcher matcher(sought.known, sought.frame, expected.image);
  expected.found = matcher.alignAll(expected.expected);
  return expected;
}

FoundFeatures FeatureFinder::findScouts(const SoughtFeatures& sought, FoundFeatures expected) const {
  const FeatureMatcher matcher(sought.known, sought.frame, expected.image);
  expected.found = matcher.alignSome(expected.expected, kScouts);
  return expected;
}

bool FeatureFinder::areFarOff(const SoughtFeatures& sought, const FoundFeatures& scouts) {
  const std::vector<FeatureMatch>& matches = scouts.found.matches;
  const int count = matchesOn(sought.followed, matches);
  const auto far = std::count_if(matches.begin(), matches.end(), [&](const FeatureMatch& match) {
    const Eigen::Vector2d predicted = sought.frame.camera.project(match.association.predicted);
    return sought.followed[match.association.piece] &&
           (predicted - Eigen::Vector2d(match.pixel.x, match.pixel.y)).norm() > kFarOff;
  });
  return count >= kFewestAssociations && 2 * far > count;
}

FoundFeatures FeatureFinder::findOthers(const SoughtFeatures& sought, FoundFeatures scouts) const {
  const FeatureMatcher matcher(sought.known, sought.frame, scouts.image);
  scouts.found = matcher.alignOthers(scouts.expected, kScouts, std::move(scouts.found));
  markOutliers(sought.frame.camera, &scouts.found.matches);
  return scouts;
}

FoundFeatures FeatureFinder::findAfter(const SoughtFeatures& sought, const RigidMotions& motions,
                                       FoundFeatures expected) const {
  const Pinhole& camera = sought.frame.camera;
  expected.expected = lookedForAfter(motions, camera, std::move(expected.expected));
  FoundFeatures features = findAll(sought, std::move(expected));
  markOutliers(camera, &features.found.matches);
  return features;
}

FoundFeatures FeatureFinder::addFromAfar(const SoughtFeatures& sought, const PredictedSurface& surface,
                                         FoundFeatures features) const {
  const cv::Mat3b& color = sought.frame.color;
  const cv::Rect region = searchRegion(surface, color.size(), kWideSearchPx);
  features.image = GrayPyramid(color, region);
  const std::vector<Keypoint> keypoints = orb_.extract(color, sought.colors.mask(color, region), region);
  const std::vector<FeatureMatch> more = FeatureMatcher(sought.known, sought.frame, features.image)
                                             .matchDescriptors(features.found.missed, keypoints);
  features.found.matches.insert(features.found.matches.end(), more.begin(), more.end());
  markOutliers(sought.frame.camera, &features.found.matches);
  return features;
}

std::vector<PointPair> FeatureFinder::recognize(const SoughtFeatures& sought, const SurfaceModel& model,
                                                const Points& vertices) const {
  const cv::Mat3b& color = sought.frame.color;
  const cv::Rect image(cv::Point(), color.size());
  cv::Mat1b mask = sought.colors.mask(color, image);
  if (!sought.frame.known.empty()) mask.setTo(0, sought.frame.known > 0.0f);
  return recognizedFeatures(sought.frame, sought.known, orb_.extract(color, mask, image), model, vertices);
}

}  // namespace softbody
