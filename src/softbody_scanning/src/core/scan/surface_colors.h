#pragma once

#include "softbody_scanning/fusion/depth_view.h"

namespace softbody::scanning {

/// Mean colour of each vertex in the views that see it, #V x 3, BGR; the mean of all vertices if none does.
/// @param views of the frames, in their order.
Points surfaceColors(const TriangleMesh& mesh, const std::vector<DepthView>& views,
                     const std::vector<KeyFrame>& frames, double inverse_depth_std);

}  // namespace softbody::scanning
