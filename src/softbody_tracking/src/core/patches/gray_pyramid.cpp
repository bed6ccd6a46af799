#include "patches/gray_pyramid.h"

#include <cstddef>
#include <opencv2/imgproc.hpp>

namespace softbody {
namespace {

cv::Size halved(const cv::Size& size) { return {(size.width + 1) / 2, (size.height + 1) / 2}; }

void pairRows(const cv::Mat1b& gray, RowPairs* pairs) {
  // A copy: bytes written might alias the member, which bars vectors.
  const std::ptrdiff_t columns = pairs->cols;
  for (int v = 0; v < pairs->rows; ++v) {
    const uchar *row = gray[v], *below = gray[v + 1];
    uchar* pair = pairs->ptr(v);
    for (std::ptrdiff_t u = 0; u < columns; ++u) {
      pair[2 * u] = row[u];
      pair[2 * u + 1] = below[u];
    }
  }
}

}  // namespace

void GrayPyramid::build(const cv::Mat3b& color, const cv::Rect& region) {
  constexpr int kStep = 1 << (kLevels - 1);
  const cv::Point first(region.x / kStep * kStep, region.y / kStep * kStep);
  const cv::Rect wide = cv::Rect(first, region.br()) & cv::Rect(cv::Point(), color.size());
  origin_ = cv::Point2f(static_cast<float>(wide.x), static_cast<float>(wide.y));
  built_ = kLevels;
  levels_ = {};
  if (wide.empty()) return;
  cv::Size size = wide.size(), whole = color.size();
  for (int l = 0; l < kLevels; ++l) {
    memory_[l].gray.create(whole);
    memory_[l].pairs.create(whole);
    levels_[l] = {memory_[l].gray(cv::Rect(cv::Point(), size)),
                  memory_[l].pairs(cv::Rect(0, 0, size.width, size.height - 1))};
    size = halved(size);
    whole = halved(whole);
  }
  cv::cvtColor(color(wide), levels_[0].gray, cv::COLOR_BGR2GRAY);
  pairRows(levels_[0].gray, &levels_[0].pairs);
  built_ = 1;
}

const RowPairs& GrayPyramid::level(int l) const {
  for (; built_ <= l; ++built_) {
    cv::pyrDown(levels_[built_ - 1].gray, levels_[built_].gray);
    pairRows(levels_[built_].gray, &levels_[built_].pairs);
  }
  return levels_[l].pairs;
}

}  // namespace softbody
