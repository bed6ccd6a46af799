#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "softbody_common/types.h"
#include "softbody_evaluation/measures/statistics.h"

namespace softbody::evaluation {

/// How far one frame's depth image is from the surface's, pixel by pixel.
struct FrameResidual {
  Nanoseconds stamp = 0;
  std::vector<float>
      residuals;  ///< |model z - measured z| where both exist and nothing occludes the model [m]
  std::size_t model_pixels = 0;  ///< where the model is in the image
  std::size_t occluded =
      0;  ///< of these: measured nearer than the model by more than the occluder's distance
  std::size_t without_depth = 0;  ///< of these: no measurement
};

/// @param model z of the surface at the pixel centres [m], 0: nothing. @param measured [m], 0 or not finite:
/// none.
/// @param occluder_m what is measured nearer than the model by more than this is something else.
/// @throw std::invalid_argument if the images differ in size.
FrameResidual depthResidual(const cv::Mat1f& model, const cv::Mat1f& measured, double occluder_m);

/// Over a run of frames.
struct ResidualReport {
  std::size_t first_frame = 0, frames = 0;
  std::size_t answered = 0;                     ///< frames in which the surface covers any pixel
  Summary residual;                             ///< [m]
  double within_10mm = 0.0, within_15mm = 0.0;  ///< shares of the residuals
  double within_15mm_of_measured = 0.0;         ///< the same with occluded pixels counted as misses
  double occluded_share = 0.0, without_depth_share = 0.0;  ///< shares of the model's pixels
};

/// @param first, count which of the frames; fewer if there are not as many.
ResidualReport summarize(const std::vector<FrameResidual>& frames, std::size_t first, std::size_t count);

}  // namespace softbody::evaluation
