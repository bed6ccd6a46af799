#include "core/flying_pixels.h"

#include <algorithm>

namespace softbody {
namespace {

constexpr int kSupport = 2;

/// Branch-free, so that compilers vectorise it. Rows are padded: pixel i of the image is at i + 1.
void filterRow(const float* __restrict above, const float* __restrict row, const float* __restrict below,
               float ratio, int width, float* __restrict result) {
  for (int i = 0; i < width; ++i) {
    const float z = row[i + 1], low = z * (1.0f - ratio), high = z * (1.0f + ratio);
    const auto near = [low, high](float n) {
      return static_cast<int>(n >= low) & static_cast<int>(n <= high);
    };
    const auto step = [low, high](float a, float b) {
      const float nearer = std::min(a, b), farther = std::max(a, b);
      return static_cast<int>(nearer > 0.0f) & static_cast<int>(nearer < low) &
             static_cast<int>(farther > high);
    };
    const int support = near(above[i]) + near(above[i + 1]) + near(above[i + 2]) + near(row[i]) +
                        near(row[i + 2]) + near(below[i]) + near(below[i + 1]) + near(below[i + 2]);
    const int steps = step(row[i], row[i + 2]) | step(above[i + 1], below[i + 1]) |
                      step(above[i], below[i + 2]) | step(above[i + 2], below[i]);
    const int keep = static_cast<int>(support >= kSupport) & (1 - steps);
    result[i] = z * static_cast<float>(keep);
  }
}

}  // namespace

cv::Mat1f removeFlyingPixels(const cv::Mat1f& depth, double ratio) {
  cv::Mat1f padded;
  cv::copyMakeBorder(depth, padded, 1, 1, 1, 1, cv::BORDER_CONSTANT, 0.0);
  cv::Mat1f result(depth.size());
  for (int v = 0; v < depth.rows; ++v) {
    filterRow(padded[v], padded[v + 1], padded[v + 2], static_cast<float>(ratio), depth.cols, result[v]);
  }
  return result;
}

}  // namespace softbody
