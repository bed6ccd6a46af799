#pragma once

#include <cstdint>
#include <vector>

#include "softbody_tracking/rgbd_frame.h"

namespace softbody {

/// Has the memory layout of a PointCloud2 point with the fields x y z rgb.
struct ColoredPoint {
  float x, y, z;      ///< camera frame [m]; NaN: no depth
  std::uint32_t rgb;  ///< 0x00RRGGBB
};

/// One point for each pixel, row by row; NaN if the pixel has no depth.
std::vector<ColoredPoint> organizedCloud(const RgbdFrame& frame);

/// One point for each occupied voxel: the mean position and colour of its pixels, in scan order.
/// @throw std::invalid_argument if the size is not above 0.
std::vector<ColoredPoint> voxelCloud(const RgbdFrame& frame, double voxel_size_m);

}  // namespace softbody
