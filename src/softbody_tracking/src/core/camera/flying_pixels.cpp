#include "camera/flying_pixels.h"

#include <algorithm>
#include <cmath>

namespace softbody {
namespace {

constexpr int kMinNearNeighbors = 2;  // of eight: a thin wire has two, a stray pixel has none

/// Whether z lies between a and b and is near neither.
int isStep(float a, float b, float z, float reach) {
  const float nearer = std::min(a, b), farther = std::max(a, b);
  return static_cast<int>(nearer > 0.0f) & static_cast<int>(nearer < z - reach) &
         static_cast<int>(farther > z + reach);
}

int isNear(float neighbor, float z, float reach) { return static_cast<int>(std::abs(neighbor - z) <= reach); }

/// Branch-free, so that compilers vectorise it. Rows are padded: pixel i of the image is at i + 1.
void filterRow(const float* __restrict above, const float* __restrict row, const float* __restrict below,
               float ratio, int width, float* __restrict result) {
  for (int i = 0; i < width; ++i) {
    const float z = row[i + 1], reach = ratio * z, diagonal = static_cast<float>(M_SQRT2) * reach;
    const int support = isNear(row[i], z, reach) + isNear(row[i + 2], z, reach) +
                        isNear(above[i + 1], z, reach) + isNear(below[i + 1], z, reach) +
                        isNear(above[i], z, diagonal) + isNear(above[i + 2], z, diagonal) +
                        isNear(below[i], z, diagonal) + isNear(below[i + 2], z, diagonal);
    const int steps = isStep(row[i], row[i + 2], z, reach) | isStep(above[i + 1], below[i + 1], z, reach) |
                      isStep(above[i], below[i + 2], z, diagonal) |
                      isStep(above[i + 2], below[i], z, diagonal);
    const int keep = static_cast<int>(support >= kMinNearNeighbors) & (1 - steps);
    result[i] = z * static_cast<float>(keep);
  }
}

}  // namespace

void FlyingPixelFilter::apply(const cv::Mat1f& depth, cv::Mat1f* result) {
  cv::copyMakeBorder(depth, padded_, 1, 1, 1, 1, cv::BORDER_CONSTANT, 0.0);
  result->create(depth.size());
  for (int v = 0; v < depth.rows; ++v) {
    filterRow(padded_[v], padded_[v + 1], padded_[v + 2], ratio_, depth.cols, (*result)[v]);
  }
}

}  // namespace softbody
