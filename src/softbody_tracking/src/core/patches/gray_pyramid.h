#pragma once

#include <array>
#include <opencv2/core.hpp>

#include "patches/patch_kernel.h"

namespace softbody {

/// Grey images of a region at full, half and quarter resolution. Pixel (u, v) of the frame lies at
/// ((u, v) - origin) / 2^level.
class GrayPyramid {
 public:
  static constexpr int kLevels = 3;  ///< full, half and quarter

  GrayPyramid() = default;  ///< of an empty region
  /// @param region of the frame; it is widened a little so that it halves evenly.
  GrayPyramid(const cv::Mat3b& color, const cv::Rect& region);

  /// The image at a level as RowPairs; empty for an empty region or a single row. A level is made when it is
  /// first used: most frames need only full resolution.
  const RowPairs& level(int l) const;
  cv::Point2f toLevel(const cv::Point2f& pixel, int l) const {
    return (pixel - origin_) * (1.0f / static_cast<float>(1 << l));
  }
  cv::Point2f toFrame(const cv::Point2f& place, int l) const {
    return place * static_cast<float>(1 << l) + origin_;
  }

 private:
  struct Level {
    cv::Mat1b gray;
    RowPairs pairs;
  };

  cv::Point2f origin_;
  mutable std::array<Level, kLevels> levels_;
  mutable int built_ = kLevels;  ///< number of levels that are made
};

}  // namespace softbody
