#pragma once

#include <array>
#include <cstdint>
#include <opencv2/features2d.hpp>
#include <vector>

namespace softbody {

/// 256-bit ORB descriptor (Rublee et al. 2011).
using Descriptor = std::array<std::uint64_t, 4>;

/// Number of differing bits, 0..256.
int hammingDistance(const Descriptor& a, const Descriptor& b);

/// A corner with its descriptor.
struct Keypoint {
  cv::Point2f pixel;
  Descriptor descriptor{};
};

/// ORB keypoints in a region of an image.
class OrbExtractor {
 public:
  OrbExtractor();

  /// Keypoints, sorted by rank within their scale: responses of different scales are not comparable.
  /// @param mask of the image's size; no keypoint where it is 0.
  std::vector<cv::KeyPoint> detect(const cv::Mat3b& color, const cv::Mat1b& mask,
                                   const cv::Rect& region) const;

  /// Adds descriptors; the finest scale comes first. @param corners some results of detect() for this region.
  std::vector<Keypoint> describe(const cv::Mat3b& color, const cv::Rect& region,
                                 std::vector<cv::KeyPoint> corners) const;

  /// All results of detect() with descriptors.
  std::vector<Keypoint> extract(const cv::Mat3b& color, const cv::Mat1b& mask, const cv::Rect& region) const;

 private:
  cv::Ptr<cv::ORB> orb_;
};

}  // namespace softbody
