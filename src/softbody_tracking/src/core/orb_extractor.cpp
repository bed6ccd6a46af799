#include "orb_extractor.h"

#include <cstring>
#include <opencv2/imgproc.hpp>

namespace softbody {
namespace {

constexpr int kPatchSize = 31;  // [px] of ORB's descriptor
constexpr int kLevels = 4;
constexpr int kFastThreshold = 10;  // low: soft bodies are low in contrast

}  // namespace

int hammingDistance(const Descriptor& a, const Descriptor& b) {
  int bits = 0;
  for (int k = 0; k < 4; ++k) bits += __builtin_popcountll(a[k] ^ b[k]);
  return bits;
}

OrbExtractor::OrbExtractor(int max_features)
    : orb_(cv::ORB::create(max_features, 1.2f, kLevels, kPatchSize, 0, 2, cv::ORB::HARRIS_SCORE, kPatchSize,
                           kFastThreshold)) {}

std::vector<Keypoint> OrbExtractor::extract(const cv::Mat3b& color, const cv::Mat1b& mask,
                                            const cv::Rect& region) {
  if (orb_->getMaxFeatures() == 0) return {};
  // Descriptors at the region's border need their patch.
  const cv::Rect padded = cv::Rect(region.x - kPatchSize, region.y - kPatchSize,
                                   region.width + 2 * kPatchSize, region.height + 2 * kPatchSize) &
                          cv::Rect(cv::Point(), color.size());
  if (padded.width <= 2 * kPatchSize || padded.height <= 2 * kPatchSize) return {};
  cv::Mat gray, descriptors;
  cv::cvtColor(color(padded), gray, cv::COLOR_BGR2GRAY);
  std::vector<cv::KeyPoint> found;
  orb_->detectAndCompute(gray, mask(padded), found, descriptors);
  std::vector<Keypoint> keypoints(found.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    keypoints[i].pixel =
        found[i].pt + cv::Point2f(static_cast<float>(padded.x), static_cast<float>(padded.y));
    keypoints[i].octave = found[i].octave;
    std::memcpy(keypoints[i].descriptor.data(), descriptors.ptr(static_cast<int>(i)), sizeof(Descriptor));
  }
  return keypoints;
}

}  // namespace softbody
