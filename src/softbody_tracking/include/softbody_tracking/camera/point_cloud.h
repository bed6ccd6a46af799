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

/// The points of the pixels with depth in every n-th row and column, at most `max_points`; n is the least
/// that allows it.
/// @throw std::invalid_argument if max_points is not above 0.
std::vector<ColoredPoint> thinnedCloud(const RgbdFrame& frame, int max_points);

}  // namespace softbody
