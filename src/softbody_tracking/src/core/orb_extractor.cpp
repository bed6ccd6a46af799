#include "orb_extractor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <opencv2/imgproc.hpp>

namespace softbody {
namespace {

constexpr int kPatchSize = 31;  // [px] of ORB's descriptor
constexpr int kLevels = 4;
constexpr float kScale = 1.2f;  // between levels
constexpr int kBorder = 54;     // [px], the patch at the coarsest level: nothing is found so near to a border
constexpr int kFewestCandidates = 500;
constexpr int kCandidates = 2;      // times those wanted: weaker ones are seldom found again
constexpr int kFewestKnown = 1000;  // that are extracted to find known features again
constexpr int kFastThreshold = 10;  // low: soft bodies are low in contrast

/// A region with the border that ORB needs around it.
cv::Rect padded(const cv::Rect& region, const cv::Size& image) {
  return cv::Rect(region.x - kBorder, region.y - kBorder, region.width + 2 * kBorder,
                  region.height + 2 * kBorder) &
         cv::Rect(cv::Point(), image);
}

/// The strongest of every level first: responses of different levels do not compare.
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

/// The first ones, spread: one that is nearer to another than so many on the free area are on average is
/// taken only where too few others are left, and so on with half the distance (after Brown et al. 2005,
/// adaptive non-maximal suppression).
/// @param free the image; 0: none is there.
std::vector<cv::KeyPoint> spread(std::vector<cv::KeyPoint> found, const cv::Mat1b& free, std::size_t wanted) {
  if (found.size() <= wanted) return found;
  const double area = cv::countNonZero(free);
  std::vector<cv::KeyPoint> taken;
  for (int distance = cvRound(std::sqrt(area / static_cast<double>(wanted))); taken.size() < wanted;
       distance /= 2) {
    cv::Mat1b open(free.size(), 255);
    const auto close = [&](const cv::KeyPoint& keypoint) {
      if (distance > 0) cv::circle(open, keypoint.pt, distance, 0, cv::FILLED);
    };
    std::for_each(taken.begin(), taken.end(), close);
    std::vector<cv::KeyPoint> left;
    for (const cv::KeyPoint& keypoint : found) {
      const bool take = taken.size() < wanted && open(keypoint.pt) != 0;
      (take ? taken : left).push_back(keypoint);
      if (take) close(keypoint);
    }
    found = std::move(left);
  }
  return taken;
}

}  // namespace

int hammingDistance(const Descriptor& a, const Descriptor& b) {
  int bits = 0;
  for (int k = 0; k < 4; ++k) bits += __builtin_popcountll(a[k] ^ b[k]);
  return bits;
}

OrbExtractor::OrbExtractor(int max_features)
    : max_features_(max_features),
      orb_(cv::ORB::create(max_features, kScale, kLevels, kPatchSize, 0, 2, cv::ORB::HARRIS_SCORE, kPatchSize,
                           kFastThreshold)) {}

std::vector<Keypoint> OrbExtractor::extract(const cv::Mat3b& color, const cv::Mat1b& mask,
                                            const cv::Rect& region) {
  return extractNew(color, mask, mask, region, max_features_);
}

std::vector<Keypoint> OrbExtractor::extractNew(const cv::Mat3b& color, const cv::Mat1b& mask,
                                               const cv::Mat1b& taken, const cv::Rect& region, int wanted) {
  return describe(color, region, wanted, [&](const cv::Mat1b& gray, const cv::Rect& wide) {
    std::vector<cv::KeyPoint> found =
        detect(gray, mask(wide), std::max(kFewestCandidates, kCandidates * wanted));
    cv::KeyPointsFilter::runByPixelsMask(found, taken(wide));
    return spread(ranked(std::move(found)), taken(wide), static_cast<std::size_t>(wanted));
  });
}

std::vector<Keypoint> OrbExtractor::extractStrongest(const cv::Mat3b& color, const cv::Mat1b& mask,
                                                     const cv::Rect& region) {
  return describe(color, region, max_features_, [&](const cv::Mat1b& gray, const cv::Rect& wide) {
    return detect(gray, mask(wide), std::max(kFewestKnown, max_features_));
  });
}

std::vector<cv::KeyPoint> OrbExtractor::detect(const cv::Mat1b& gray, const cv::Mat1b& mask, int most) {
  orb_->setMaxFeatures(most);
  std::vector<cv::KeyPoint> found;
  orb_->detect(gray, found, mask);
  return found;
}

template <typename Find>
std::vector<Keypoint> OrbExtractor::describe(const cv::Mat3b& color, const cv::Rect& region, int wanted,
                                             const Find& find) {
  const cv::Rect wide = padded(region, color.size());
  if (wanted <= 0 || wide.width <= 2 * kPatchSize || wide.height <= 2 * kPatchSize) return {};
  cv::Mat1b gray;
  cv::cvtColor(color(wide), gray, cv::COLOR_BGR2GRAY);
  std::vector<cv::KeyPoint> found = find(gray, wide);
  cv::Mat descriptors;
  orb_->compute(gray, found, descriptors);
  const cv::Point2f origin(wide.tl());
  std::vector<Keypoint> keypoints(found.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    keypoints[i].pixel = found[i].pt + origin;
    keypoints[i].octave = found[i].octave;
    std::memcpy(keypoints[i].descriptor.data(), descriptors.ptr(static_cast<int>(i)), sizeof(Descriptor));
  }
  return keypoints;
}

}  // namespace softbody
