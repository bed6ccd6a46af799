#pragma once

#include <cstdint>
#include <vector>

#include "softbody_tracking/rgbd_frame.h"

namespace softbody {

/// Laid out as a PointCloud2 point x y z rgb.
struct ColoredPoint {
  float x, y, z;      ///< [m], camera frame; NaN: none
  std::uint32_t rgb;  ///< 0x00RRGGBB
};

/// One point a pixel, row by row, NaN where there is no depth.
std::vector<ColoredPoint> organizedCloud(const RgbdFrame& frame);

/// One point for every cube of this size that holds pixels: their mean position and colour, in scan order.
/// @throw std::invalid_argument if the size is not above 0.
std::vector<ColoredPoint> voxelCloud(const RgbdFrame& frame, double voxel_size_m);

}  // namespace softbody
