#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace softbody {

/// Which colours belong to the body: a histogram over hue-like chroma and lightness (CIE L*a*b*), learned
/// from the pixels where the registered model and the depth agree. A hand or a tool that touches the body
/// mostly fails it.
class ColorModel {
 public:
  /// @param mask pixels of the body (non-zero). Few pixels (< 200) leave the model unlearned: everything
  /// passes.
  void learn(const cv::Mat3b& color, const cv::Mat1b& mask);
  bool learned() const { return !of_body_.empty(); }

  /// Whether a pixel's colour (blue, green, red) is one of the body's; everything is before learn().
  bool belongs(const cv::Vec3b& color) const {
    return !learned() || of_body_[(color[0] >> 3 << 10) | (color[1] >> 3 << 5) | color[2] >> 3] != 0;
  }
  /// 255 where a pixel's colour is one of the body's, 0 elsewhere, inside the region; size of the image.
  cv::Mat1b mask(const cv::Mat3b& color, const cv::Rect& region) const;

  void reset() { of_body_.clear(); }

 private:
  std::vector<unsigned char> of_body_;  ///< one entry for every 8 by 8 by 8 colours
};

}  // namespace softbody
