#include "features/orb_extractor.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <opencv2/imgproc.hpp>

namespace softbody {
namespace {

// Side of ORB's patch [px]; the value of the paper.
constexpr int kOrbPatchSize = 31;
// Pyramid levels and the scale between them: a body comes closer or goes away by a factor of 1.7 at most.
constexpr int kLevels = 4;
constexpr float kScale = 1.2f;  // 1.2^3 = 1.7
// Size of the patch at the coarsest level [px]; nothing is found closer to a border.
constexpr int kBorder = 54;
// Keypoints in a region; weak ones too, because strong ones may leave large gaps.
constexpr int kMost = 4000;
// Threshold of the FAST corner test; low, because soft bodies have low contrast.
constexpr int kFastThreshold = 10;

/// A region with the border that ORB needs around it.
cv::Rect padded(const cv::Rect& region, const cv::Size& image) {
  return cv::Rect(region.x - kBorder, region.y - kBorder, region.width + 2 * kBorder,
                  region.height + 2 * kBorder) &
         cv::Rect(cv::Point(), image);
}

/// Sorts by rank within the level: responses of different levels are not comparable.
std::vector<cv::KeyPoint> ranked(std::vector<cv::KeyPoint> found) {
  std::stable_sort(found.begin(), found.end(),
                   [](const cv::KeyPoint& a, const cv::KeyPoint& b) { return a.response > b.response; });
  std::array<int, kLevels> count{}, before{};
  for (const cv::KeyPoint& keypoint : found) ++count.at(static_cast<std::size_t>(keypoint.octave));
  for (cv::KeyPoint& keypoint : found) {
    const auto level = static_cast<std::size_t>(keypoint.octave);
    keypoint.response = 1.0f - static_cast<float>(before.at(level)++) / static_cast<float>(count.at(level));
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const cv::KeyPoint& a, const cv::KeyPoint& b) { return a.response > b.response; });
  return found;
}

bool isTooSmall(const cv::Rect& region) {
  return region.width <= 2 * kOrbPatchSize || region.height <= 2 * kOrbPatchSize;
}

cv::Mat1b grayOf(const cv::Mat3b& color, const cv::Rect& region) {
  cv::Mat1b gray;
  cv::cvtColor(color(region), gray, cv::COLOR_BGR2GRAY);
  return gray;
}

void shift(const cv::Point2f& offset, std::vector<cv::KeyPoint>* keypoints) {
  for (cv::KeyPoint& keypoint : *keypoints) keypoint.pt += offset;
}

}  // namespace

/// Counts in fields of 2, 4, 8 and 16 bits (Warren, Hacker's Delight, 5-1). A lost frame needs millions of
/// counts, and some processors that Debian supports have no instruction for it.
int hammingDistance(const Descriptor& a, const Descriptor& b) {
  std::uint64_t bytes = 0;
  for (int k = 0; k < 4; ++k) {
    std::uint64_t bits = a[k] ^ b[k];
    bits -= (bits >> 1) & 0x5555555555555555u;
    bits = (bits & 0x3333333333333333u) + ((bits >> 2) & 0x3333333333333333u);
    bytes += (bits + (bits >> 4)) & 0x0f0f0f0f0f0f0f0fu;
  }
  const std::uint64_t words = (bytes & 0x00ff00ff00ff00ffu) + ((bytes >> 8) & 0x00ff00ff00ff00ffu);
  return static_cast<int>((words * 0x0001000100010001u) >> 48);
}

OrbExtractor::OrbExtractor()
    : orb_(cv::ORB::create(kMost, kScale, kLevels, kOrbPatchSize, 0, 2, cv::ORB::HARRIS_SCORE, kOrbPatchSize,
                           kFastThreshold)) {}

std::vector<cv::KeyPoint> OrbExtractor::detect(const cv::Mat3b& color, const cv::Mat1b& mask,
                                               const cv::Rect& region) const {
  const cv::Rect wide = padded(region, color.size());
  if (isTooSmall(wide)) return {};
  std::vector<cv::KeyPoint> found;
  orb_->detect(grayOf(color, wide), found, mask(wide));
  shift(wide.tl(), &found);
  return ranked(std::move(found));
}

std::vector<Keypoint> OrbExtractor::describe(const cv::Mat3b& color, const cv::Rect& region,
                                             std::vector<cv::KeyPoint> corners) const {
  const cv::Rect wide = padded(region, color.size());
  if (isTooSmall(wide) || corners.empty()) return {};
  shift(-wide.tl(), &corners);
  cv::Mat descriptors;
  orb_->compute(grayOf(color, wide), corners, descriptors);
  shift(wide.tl(), &corners);
  std::vector<Keypoint> keypoints(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    keypoints[i].pixel = corners[i].pt;
    std::memcpy(keypoints[i].descriptor.data(), descriptors.ptr(static_cast<int>(i)), sizeof(Descriptor));
  }
  return keypoints;
}

std::vector<Keypoint> OrbExtractor::extract(const cv::Mat3b& color, const cv::Mat1b& mask,
                                            const cv::Rect& region) const {
  return describe(color, region, detect(color, mask, region));
}

}  // namespace softbody
