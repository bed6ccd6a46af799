#pragma once

#include <opencv2/core.hpp>

#include "softbody_common/geometry/pinhole.h"
#include "softbody_common/geometry/types.h"

namespace softbody::evaluation {

/// Draws the outline of the mesh, and lines that are fixed to the body: where planes at equal distance cut
/// the mesh at rest. The image stays visible between them, so that slipping texture can be judged.
void drawOutlineAndLines(const Pinhole& camera, const Points& vertices, const MeshTopology& mesh,
                         cv::Mat3b* image);

}  // namespace softbody::evaluation
