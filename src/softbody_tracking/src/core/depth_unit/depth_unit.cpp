#include "softbody_tracking/depth_unit/depth_unit.h"

#include <cmath>

#include "softbody_common/camera_topics.h"
#include "softbody_tracking/tracker/body_tracker.h"

namespace softbody {

std::optional<double> depthUnitThatFits(CameraImages images, CameraIngest* ingest,
                                        const TrackerConfig& config, const TetTopology& volume,
                                        const MeshTopology& surface) {
  const double present = unitOf(images);
  for (const double unit_m : kDepthUnits_m) {
    if (std::abs(unit_m - present) < 1e-3 * present) continue;
    images.depth_unit_m = unit_m;
    BodyTracker tracker(config);
    tracker.setTopologies(volume, surface);
    StageTimer timer;
    if (tracker.track(ingest->process(images), nullptr, &timer).has_targets) return unit_m;
  }
  return std::nullopt;
}

}  // namespace softbody
