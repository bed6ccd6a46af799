#pragma once

#include <algorithm>
#include <opencv2/core.hpp>

namespace softbody::scanning {

/// Bilinear colour of an image; pixel centres are at integer coordinates.
inline cv::Vec3f colorAt(const cv::Mat3b& image, double u, double v) {
  const auto x = static_cast<float>(std::clamp(u, 0.0, image.cols - 1.0));
  const auto y = static_cast<float>(std::clamp(v, 0.0, image.rows - 1.0));
  const int x0 = std::min(static_cast<int>(x), image.cols - 2),
            y0 = std::min(static_cast<int>(y), image.rows - 2);
  const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
  const cv::Vec3b* above = image[y0] + x0;
  const cv::Vec3b* below = image[y0 + 1] + x0;
  cv::Vec3f color;
  for (int k = 0; k < 3; ++k)
    color[k] = (1.0f - fy) * ((1.0f - fx) * above[0][k] + fx * above[1][k]) +
               fy * ((1.0f - fx) * below[0][k] + fx * below[1][k]);
  return color;
}

}  // namespace softbody::scanning
