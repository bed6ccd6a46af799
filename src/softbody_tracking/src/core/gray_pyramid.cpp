#include "gray_pyramid.h"

#include <opencv2/imgproc.hpp>

namespace softbody {
namespace {

cv::Size halved(const cv::Size& size) { return {(size.width + 1) / 2, (size.height + 1) / 2}; }

}  // namespace

void GrayPyramid::build(const cv::Mat3b& color, const cv::Rect& region) {
  constexpr int kStep = 1 << (kLevels - 1);
  const cv::Point first(region.x / kStep * kStep, region.y / kStep * kStep);
  const cv::Rect wide = cv::Rect(first, region.br()) & cv::Rect(cv::Point(), color.size());
  origin_ = cv::Point2f(static_cast<float>(wide.x), static_cast<float>(wide.y));
  cv::Size size = wide.size(), whole = color.size();
  for (int l = 0; l < kLevels; ++l) {
    memory_[l].create(whole);
    levels_[l] = memory_[l](cv::Rect(cv::Point(), size));
    size = halved(size);
    whole = halved(whole);
  }
  if (!wide.empty()) cv::cvtColor(color(wide), levels_[0], cv::COLOR_BGR2GRAY);
  built_ = wide.empty() ? kLevels : 1;
}

const cv::Mat1b& GrayPyramid::level(int l) const {
  for (; built_ <= l; ++built_) cv::pyrDown(levels_[built_ - 1], levels_[built_]);
  return levels_[l];
}

}  // namespace softbody
