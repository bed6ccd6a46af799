#pragma once

#include <vector>

#include "prediction/predicted_surface.h"

namespace softbody {

/// A block of pixels on the predicted surface, and the material point at its centre.
struct SurfaceSample {
  cv::Point center;  ///< [px]
  MaterialPoint place;
  std::uint32_t piece = 0;                             ///< the piece of the body
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< camera frame [m]
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();    ///< unit, outward
};

/// The visible surface in blocks of pixels on a regular grid.
struct SurfaceSamples {
  int block_px = 1;  ///< side of a block
  std::vector<SurfaceSample> samples;
  cv::Mat1i grid;  ///< index of a block's sample; -1: none
};

/// Samples the rendered surface. @param wanted approximate number.
SurfaceSamples sampleSurface(const PredictedSurface& surface, int wanted);

/// Number of the volume's vertices with a sample in one of their tets.
int shownVertices(const SurfaceSamples& samples, const TetTopology& volume);

}  // namespace softbody
