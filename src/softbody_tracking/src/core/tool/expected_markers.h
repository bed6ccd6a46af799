#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "softbody_common/geometry/pinhole.h"
#include "softbody_tracking/tool/tool_description.h"
#include "tool/pose_motion.h"

namespace softbody {

/// Where and how large the tool's markers are expected in an image.
struct ExpectedMarkers {
  cv::Rect region;     ///< part of the image; may be empty
  double cell_px = 0;  ///< mean side of a cell
};

/// The region holds the markers, with a white margin of one cell, in 99.95 % of the poses that are predicted.
/// @param cells along a marker's side, with the black border. @return nothing if a marker may come too near
/// to the camera plane to be projected.
std::optional<ExpectedMarkers> expectedMarkers(const ToolDescription& tool, int cells, const Pinhole& camera,
                                               const PoseMotion::Prediction& predicted);

}  // namespace softbody
