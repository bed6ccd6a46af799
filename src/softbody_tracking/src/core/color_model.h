#pragma once

#include <opencv2/core.hpp>

namespace softbody {

/// Which colours belong to the body: a histogram over hue-like chroma and lightness (CIE L*a*b*), learned
/// from the pixels where the registered model and the depth agree. A hand or a tool that touches the body
/// mostly fails it.
class ColorModel {
 public:
  /// @param mask pixels of the body (non-zero). Few pixels (< 200) leave the model unlearned: everything
  /// passes.
  void learn(const cv::Mat3b& color, const cv::Mat1b& mask);
  bool learned() const { return !histogram_.empty(); }

  /// 255 where a pixel's colour is one of the body's, 0 elsewhere, inside the region; size of the image.
  cv::Mat1b mask(const cv::Mat3b& color, const cv::Rect& region) const;

  void reset() { histogram_.release(); }

 private:
  cv::Mat1f histogram_;  ///< density relative to the mean over the body's own pixels, one row a bin
};

}  // namespace softbody
