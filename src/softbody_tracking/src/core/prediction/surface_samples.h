#pragma once

#include <vector>

#include "prediction/predicted_surface.h"

namespace softbody {

/// A block of pixels that show the predicted surface, and the material point in its middle.
struct SurfaceSample {
  cv::Point center;  ///< [px]
  MaterialPoint place;
  std::uint32_t body = 0;    ///< the piece that it belongs to
  Eigen::Vector3d position;  ///< camera frame [m]
  Eigen::Vector3d normal;    ///< unit, outward
};

/// The visible surface in blocks of pixels on a regular grid.
struct SurfaceSamples {
  int block_px = 1;  ///< side of a block
  std::vector<SurfaceSample> samples;
  cv::Mat1i grid;  ///< sample of a block, -1: none
};

/// About as many samples as wanted. @param memory what an earlier call gave, for its memory.
SurfaceSamples sampleSurface(const PredictedSurface& surface, int wanted, SurfaceSamples memory = {});

/// How many of the volume's vertices have a sample in one of their tets.
int shownVertices(const SurfaceSamples& samples, const TetTopology& volume);

}  // namespace softbody
