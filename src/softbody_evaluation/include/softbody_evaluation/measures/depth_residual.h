#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "softbody_common/geometry/types.h"
#include "softbody_evaluation/measures/statistics.h"

namespace softbody::evaluation {

/// Differences between measured depth and the result's surface, in one frame.
struct FrameResidual {
  Nanoseconds stamp = 0;
  std::vector<float> residuals;   ///< |model z - measured z| of pixels with both, without occluder [m]
  std::size_t model_pixels = 0;   ///< pixels of the model
  std::size_t occluded = 0;       ///< of these: pixels of an occluder
  std::size_t without_depth = 0;  ///< of these: pixels without a measurement
};

/// @param model z of the surface at the pixel centres [m]; 0: nothing.
/// @param measured [m]; 0 or not finite: no measurement.
/// @param occluder_m depth that is nearer than the model by more than this belongs to an occluder.
/// @throw std::invalid_argument if the images differ in size.
FrameResidual depthResidual(const cv::Mat1f& model, const cv::Mat1f& measured, double occluder_m);

/// The residuals of several frames.
struct ResidualReport {
  std::size_t first_frame = 0, frames = 0;
  std::size_t answered = 0;                                ///< frames in which the surface covers a pixel
  Summary residual;                                        ///< [m]
  double within_10mm = 0.0, within_15mm = 0.0;             ///< shares of the residuals
  double within_15mm_of_measured = 0.0;                    ///< the same, but occluded pixels count as misses
  double occluded_share = 0.0, without_depth_share = 0.0;  ///< shares of the model's pixels
};

/// @param first, count the range of frames; it is clipped to the frames given.
ResidualReport summarize(const std::vector<FrameResidual>& frames, std::size_t first, std::size_t count);

}  // namespace softbody::evaluation
