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
  int octave = 0;
  Descriptor descriptor{};
};

/// ORB keypoints with descriptors inside a mask.
class OrbExtractor {
 public:
  explicit OrbExtractor(int max_features);

  /// So many as are wanted: the strongest ones, spread over the mask.
  /// @param region only this part of the image is looked at. @param mask size of the image, 0: nowhere.
  std::vector<Keypoint> extract(const cv::Mat3b& color, const cv::Mat1b& mask, const cv::Rect& region);

  /// The same of those that are new. @param taken like the mask, 0: known already.
  /// @param wanted so many at most.
  std::vector<Keypoint> extractNew(const cv::Mat3b& color, const cv::Mat1b& mask, const cv::Mat1b& taken,
                                   const cv::Rect& region, int wanted);

  /// The strongest ones, in which known features are found again wherever these lie.
  std::vector<Keypoint> extractStrongest(const cv::Mat3b& color, const cv::Mat1b& mask,
                                         const cv::Rect& region);

 private:
  std::vector<cv::KeyPoint> detect(const cv::Mat1b& gray, const cv::Mat1b& mask, int most);
  /// @param find keypoints in the region with its border, and that region -> keypoints.
  template <typename Find>
  std::vector<Keypoint> describe(const cv::Mat3b& color, const cv::Rect& region, int wanted,
                                 const Find& find);

  int max_features_;
  cv::Ptr<cv::ORB> orb_;
};

}  // namespace softbody
