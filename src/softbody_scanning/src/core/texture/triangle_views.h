#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "softbody_common/geometry/types.h"
#include "softbody_scanning/key_frames/key_frame.h"

namespace softbody::scanning {

/// A triangle, seen by a frame.
struct TriangleView {
  int frame = -1;
  float quality = 0.0f;  ///< area in the image [px^2] x contrast of the frame's edges x cosine of the angle
  cv::Vec3f color;       ///< mean over the triangle, BGR, 0..255
};

/// Per triangle, its views in the order of the frames.
using TriangleViews = std::vector<std::vector<TriangleView>>;

/// The frames that see a triangle whole: no part of the mesh is before it, and nothing else by the measured
/// depth, which must agree with the mesh's up to the tolerance [m] two pixels around, where there is depth.
TriangleViews findViews(const TriangleMesh& mesh, const std::vector<KeyFrame>& frames,
                        double depth_tolerance_m);

}  // namespace softbody::scanning
