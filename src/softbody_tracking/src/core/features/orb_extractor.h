#pragma once

#include <array>
#include <cstdint>
#include <opencv2/features2d.hpp>
#include <vector>

namespace softbody {

/// 256-bit ORB descriptor (Rublee et al. 2011).
using Descriptor = std::array<std::uint64_t, 4>;

/// Differing bits, 0..256.
int hammingDistance(const Descriptor& a, const Descriptor& b);

struct Keypoint {
  cv::Point2f pixel;
  Descriptor descriptor{};
};

/// ORB keypoints in a region of an image.
class OrbExtractor {
 public:
  OrbExtractor();

  /// The strongest of every scale first: responses of different scales do not compare.
  /// @param mask size of the image, 0: nothing is looked for.
  std::vector<cv::KeyPoint> detect(const cv::Mat3b& color, const cv::Mat1b& mask, const cv::Rect& region);

  /// With descriptors, those of the finest scale first. @param corners some of those that detect() found in
  /// the region.
  std::vector<Keypoint> describe(const cv::Mat3b& color, const cv::Rect& region,
                                 std::vector<cv::KeyPoint> corners);

  /// All of detect() with descriptors.
  std::vector<Keypoint> extract(const cv::Mat3b& color, const cv::Mat1b& mask, const cv::Rect& region);

 private:
  cv::Ptr<cv::ORB> orb_;
};

}  // namespace softbody
