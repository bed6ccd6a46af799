#pragma once

#include <optional>

#include "softbody_common/geometry/types.h"
#include "softbody_tracking/camera/camera_ingest.h"
#include "softbody_tracking/tracker_config.h"

namespace softbody {

/// The unit of depth in which a frame shows the body: with another one the scene has another size. It is one
/// of kDepthUnits_m, and not the present one.
/// @return metres per unit; nothing: the body is found in none of them.
std::optional<double> depthUnitThatFits(CameraImages images, CameraIngest* ingest,
                                        const TrackerConfig& config, const TetTopology& volume,
                                        const MeshTopology& surface);

}  // namespace softbody
