#include "softbody_tracking/camera/point_cloud.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <unordered_map>

namespace softbody {
namespace {

struct Voxel {
  double x = 0.0, y = 0.0, z = 0.0, blue = 0.0, green = 0.0, red = 0.0;
  double pixels = 0.0;
};

std::uint32_t packed(double red, double green, double blue) {
  const auto byte = [](double value) { return static_cast<std::uint32_t>(std::lround(value)); };
  return byte(red) << 16 | byte(green) << 8 | byte(blue);
}

ColoredPoint meanOf(const Voxel& sum) {
  const double n = sum.pixels;
  return {static_cast<float>(sum.x / n), static_cast<float>(sum.y / n), static_cast<float>(sum.z / n),
          packed(sum.red / n, sum.green / n, sum.blue / n)};
}

/// 21 bits for each coordinate: +-1000 m at a voxel size of 1 mm.
std::uint64_t voxelKey(const Eigen::Vector3d& point, double size) {
  std::uint64_t key = 0;
  for (int k = 0; k < 3; ++k) {
    const auto cell = static_cast<std::int64_t>(std::floor(point[k] / size)) + (1 << 20);
    key = key << 21 | (static_cast<std::uint64_t>(cell) & 0x1fffff);
  }
  return key;
}

ColoredPoint pointOfPixel(const RgbdFrame& frame, int u, int v) {
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  const Pinhole& camera = frame.camera;
  const auto x = static_cast<float>((u - camera.cx) / camera.fx);
  const auto y = static_cast<float>((v - camera.cy) / camera.fy);
  const float z = frame.depth(v, u) > 0.0f ? frame.depth(v, u) : kNone;
  const cv::Vec3b& bgr = frame.color(v, u);
  return {x * z, y * z, z, static_cast<std::uint32_t>(bgr[2] << 16 | bgr[1] << 8 | bgr[0])};
}

}  // namespace

std::vector<ColoredPoint> organizedCloud(const RgbdFrame& frame) {
  std::vector<ColoredPoint> points(frame.depth.total());
  auto point = points.begin();
  for (int v = 0; v < frame.depth.rows; ++v) {
    for (int u = 0; u < frame.depth.cols; ++u) *point++ = pointOfPixel(frame, u, v);
  }
  return points;
}

std::vector<ColoredPoint> thinnedCloud(const RgbdFrame& frame, int max_points) {
  if (max_points <= 0) throw std::invalid_argument("thinnedCloud: the number of points must be above 0");
  const auto kept = [&frame](int step) {
    return std::int64_t{(frame.depth.rows + step - 1) / step} * ((frame.depth.cols + step - 1) / step);
  };
  int step = 1;
  while (kept(step) > max_points) ++step;
  std::vector<ColoredPoint> points;
  for (int v = 0; v < frame.depth.rows; v += step) {
    for (int u = 0; u < frame.depth.cols; u += step) {
      if (frame.depth(v, u) > 0.0f) points.push_back(pointOfPixel(frame, u, v));
    }
  }
  return points;
}

std::vector<ColoredPoint> voxelCloud(const RgbdFrame& frame, double voxel_size_m) {
  if (!(voxel_size_m > 0.0)) throw std::invalid_argument("voxelCloud: the voxel size must be above 0");
  std::unordered_map<std::uint64_t, std::size_t> index;
  std::vector<Voxel> voxels;
  std::uint64_t last_key = 0;
  std::size_t last = 0;
  for (int v = 0; v < frame.depth.rows; ++v) {
    for (int u = 0; u < frame.depth.cols; ++u) {
      const double z = frame.depth(v, u);
      if (!(z > 0.0)) continue;
      const Eigen::Vector3d p = frame.camera.unproject(u, v, z);
      const std::uint64_t key = voxelKey(p, voxel_size_m);
      // Neighbouring pixels mostly share a voxel: this saves the look-up.
      if (voxels.empty() || key != last_key) {
        const auto [entry, is_new] = index.emplace(key, voxels.size());
        if (is_new) voxels.emplace_back();
        last_key = key;
        last = entry->second;
      }
      const cv::Vec3b& bgr = frame.color(v, u);
      Voxel& sum = voxels[last];
      sum = {sum.x + p.x(),      sum.y + p.y(),    sum.z + p.z(),   sum.blue + bgr[0],
             sum.green + bgr[1], sum.red + bgr[2], sum.pixels + 1.0};
    }
  }
  std::vector<ColoredPoint> points;
  points.reserve(voxels.size());
  for (const Voxel& sum : voxels) points.push_back(meanOf(sum));
  return points;
}

}  // namespace softbody
