#include "patches/gray_pyramid.h"

#include <cstddef>
#include <opencv2/imgproc.hpp>

namespace softbody {
namespace {

RowPairs pairedRows(const cv::Mat1b& gray) {
  RowPairs pairs(gray.rows - 1, gray.cols);
  // A copy: bytes written might alias the member, which bars vectors.
  const std::ptrdiff_t columns = pairs.cols;
  for (int v = 0; v < pairs.rows; ++v) {
    const uchar *row = gray[v], *below = gray[v + 1];
    uchar* pair = pairs.ptr(v);
    for (std::ptrdiff_t u = 0; u < columns; ++u) {
      pair[2 * u] = row[u];
      pair[2 * u + 1] = below[u];
    }
  }
  return pairs;
}

}  // namespace

GrayPyramid::GrayPyramid(const cv::Mat3b& color, const cv::Rect& region) {
  constexpr int kStep = 1 << (kLevels - 1);
  const cv::Point first(region.x / kStep * kStep, region.y / kStep * kStep);
  const cv::Rect wide = cv::Rect(first, region.br()) & cv::Rect(cv::Point(), color.size());
  origin_ = cv::Point2f(static_cast<float>(wide.x), static_cast<float>(wide.y));
  if (wide.empty()) return;
  cv::cvtColor(color(wide), levels_[0].gray, cv::COLOR_BGR2GRAY);
  levels_[0].pairs = pairedRows(levels_[0].gray);
  built_ = 1;
}

const RowPairs& GrayPyramid::level(int l) const {
  for (; built_ <= l; ++built_) {
    cv::pyrDown(levels_[built_ - 1].gray, levels_[built_].gray);
    levels_[built_].pairs = pairedRows(levels_[built_].gray);
  }
  return levels_[l].pairs;
}

}  // namespace softbody
