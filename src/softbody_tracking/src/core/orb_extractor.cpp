#include "orb_extractor.h"

#include <cstring>
#include <opencv2/imgproc.hpp>

namespace softbody {
namespace {

constexpr int kPatchSize = 31;  // [px] of ORB's descriptor
constexpr int kLevels = 4;
constexpr float kScale = 1.2f;  // between levels
constexpr int kBorder = 54;     // [px], the patch at the coarsest level: nothing is found so near to a border
constexpr int kFastThreshold = 10;  // low: soft bodies are low in contrast

/// A region with the border that ORB needs around it.
cv::Rect padded(const cv::Rect& region, const cv::Size& image) {
  return cv::Rect(region.x - kBorder, region.y - kBorder, region.width + 2 * kBorder,
                  region.height + 2 * kBorder) &
         cv::Rect(cv::Point(), image);
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
  return extractNew(color, mask, mask, region, 1.0);
}

std::vector<Keypoint> OrbExtractor::extractNew(const cv::Mat3b& color, const cv::Mat1b& mask,
                                               const cv::Mat1b& taken, const cv::Rect& region, double share) {
  const cv::Rect wide = padded(region, color.size());
  const int wanted = cvCeil(share * max_features_);
  if (wanted == 0 || wide.width <= 2 * kPatchSize || wide.height <= 2 * kPatchSize) return {};
  orb_->setMaxFeatures(wanted);
  cv::Mat gray, descriptors;
  cv::cvtColor(color(wide), gray, cv::COLOR_BGR2GRAY);
  std::vector<cv::KeyPoint> found;
  orb_->detect(gray, found, mask(wide));
  cv::KeyPointsFilter::runByPixelsMask(found, taken(wide));
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
