#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "prediction/region_colors.h"

namespace softbody {

/// The middle of every block of 8 by 8 by 8 colours, in CIE L*a*b*; 1 by 32768.
cv::Mat3b paletteInLab();

/// Which colours belong to the body: a histogram over chroma and lightness (CIE L*a*b*), learned where the
/// prediction and the depth agree. It separates most hands and tools from the body that they touch.
class ColorModel {
 public:
  /// @param mask non-zero at pixels of the body. With less than 200 of them nothing is learned.
  void learn(const cv::Mat3b& color, const cv::Mat1b& mask);
  bool learned() const { return !of_body_.empty(); }

  /// Whether a colour (blue, green, red) belongs to the body; every colour does before learn().
  bool belongs(const cv::Vec3b& color) const {
    return !learned() || of_body_[(color[0] >> 3 << 10) | (color[1] >> 3 << 5) | color[2] >> 3] != 0;
  }
  /// Mask of the image's size: 255 inside the region at pixels with colours of the body, else 0. All 255
  /// before learn().
  cv::Mat1b mask(const cv::Mat3b& color, const cv::Rect& region) const;

  /// Colours beside and on the body in the last frames, and how they tell the two apart.
  const RegionColors& region() const { return region_; }
  void learnRegion(const RgbdFrame& frame, const RasterImage& rendered, double elapsed_s) {
    region_.learn(frame, rendered, elapsed_s);
  }

  /// Forgets what was learned.
  void reset() { of_body_.clear(), region_.reset(); }

 private:
  RegionColors region_;
  cv::Mat3b palette_ = paletteInLab();  ///< made before the first image: OpenCV's tables for Lab take 0.1 s
  std::vector<unsigned char>
      of_body_;  ///< an entry for every block of 8 by 8 by 8 colours; empty before learn()
};

/// Pixels from which the colours of the body can be learned: 255 where the depth agrees with the rendered
/// prediction, without the border of these areas.
cv::Mat1b agreeingPixels(const cv::Mat1f& rendered, const cv::Mat1f& measured);

}  // namespace softbody
