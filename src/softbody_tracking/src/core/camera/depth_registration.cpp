#include "camera/depth_registration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace softbody {
namespace {

// Squares of a slanted surface are farther apart than those of a surface that faces the camera.
constexpr double kOverlap = 1.2;

/// The pixels first <= i < last whose centres an interval covers.
struct PixelRange {
  PixelRange(double centre, double half_width, int size)
      : first(static_cast<int>(std::clamp(std::ceil(centre - half_width), 0.0, 1.0 * size))),
        last(static_cast<int>(std::clamp(std::floor(centre + half_width) + 1.0, 0.0, 1.0 * size))) {}
  int first, last;
};

void drawSquare(const Eigen::Vector3d& point, double half_width, double half_height, const Pinhole& camera,
                cv::Mat1f* depth) {
  const Eigen::Vector2d pixel = camera.project(point);
  const PixelRange columns(pixel.x(), half_width, camera.width), rows(pixel.y(), half_height, camera.height);
  const auto z = static_cast<float>(point.z());
  for (int v = rows.first; v < rows.last; ++v) {
    float* row = (*depth)[v];
    for (int u = columns.first; u < columns.last; ++u)
      if (!(row[u] <= z)) row[u] = z;
  }
}

}  // namespace

cv::Mat1f registeredDepth(const cv::Mat1f& depth, const Pinhole& from, const Eigen::Isometry3d& T_to_from,
                          const Pinhole& to) {
  if (depth.cols != from.width || depth.rows != from.height) {
    throw std::invalid_argument(
        fmt::format("the depth image has {}x{} pixels, but its camera_info says {}x{}", depth.cols,
                    depth.rows, from.width, from.height));
  }
  const double width = 0.5 * kOverlap * to.fx / from.fx, height = 0.5 * kOverlap * to.fy / from.fy;
  cv::Mat1f result(to.height, to.width, std::numeric_limits<float>::quiet_NaN());
  for (int v = 0; v < depth.rows; ++v) {
    for (int u = 0; u < depth.cols; ++u) {
      const double z = depth(v, u);
      if (!(z > 0.0)) continue;
      const Eigen::Vector3d point = T_to_from * from.unproject(u, v, z);
      const double scale = z / point.z();
      // So near that one pixel would fill the image: no camera measures that.
      if (point.z() <= 0.0 || width * scale > to.width) continue;
      // At least half a pixel, so that a coarser camera keeps every point.
      drawSquare(point, std::max(0.5, width * scale), std::max(0.5, height * scale), to, &result);
    }
  }
  return result;
}

}  // namespace softbody
