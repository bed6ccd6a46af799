#include "gray_pyramid.h"

#include <opencv2/imgproc.hpp>

namespace softbody {

void GrayPyramid::build(const cv::Mat3b& color, const cv::Rect& region) {
  constexpr int kStep = 1 << (kLevels - 1);
  const cv::Point first(region.x / kStep * kStep, region.y / kStep * kStep);
  const cv::Rect wide = cv::Rect(first, region.br()) & cv::Rect(cv::Point(), color.size());
  origin_ = cv::Point2f(static_cast<float>(wide.x), static_cast<float>(wide.y));
  if (wide.empty()) {
    for (cv::Mat1b& level : levels_) level.release();
    return;
  }
  cv::cvtColor(color(wide), levels_[0], cv::COLOR_BGR2GRAY);
  for (int l = 1; l < kLevels; ++l) cv::pyrDown(levels_[l - 1], levels_[l]);
}

}  // namespace softbody
