#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "records/recorded_frame.h"
#include "softbody_common/geometry/types.h"

namespace softbody::evaluation {

/// Distance of each vertex from its true place [m]; NaN without a match. @param matches from matchVertices.
std::vector<float> trueErrors(const MeshState& state, const MeshState& truth,
                              const std::vector<int>& matches);

/// Distance along the camera's axis of each visible vertex from the measured depth [m]; NaN where it is
/// hidden or nothing was measured. @param rendered z of the mesh in the frame's camera [m].
std::vector<float> depthErrors(const MeshState& state, const RecordedFrame& frame, const cv::Mat1f& rendered,
                               double occluder_m);

/// The mesh from the camera's side, the left, the back and the right, painted with errors, and the scale of
/// the colours. @param radius_m of the body, fills the picture.
cv::Mat3b paintSides(const Points& vertices, const Triangles& triangles, const std::vector<float>& errors_m,
                     double radius_m);

}  // namespace softbody::evaluation
