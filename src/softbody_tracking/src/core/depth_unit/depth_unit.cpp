#include "softbody_tracking/depth_unit/depth_unit.h"

#include <cmath>

#include "softbody_common/geometry/rigid_fit.h"
#include "softbody_common/protocol/camera_topics.h"
#include "softbody_tracking/tracker/body_tracker.h"

namespace softbody {
namespace {

/// Whether all vertices are within the image: where the outline is outside of it, any wall would fit.
/// @param vertices camera frame [m].
bool isWhollyShown(const Points& vertices, const Pinhole& camera) {
  for (const auto& vertex : vertices.rowwise()) {
    const Eigen::Vector3d point = vertex;
    const Eigen::Vector2d pixel = camera.project(point);
    if (point.z() <= 0.0 || !camera.contains(pixel.x(), pixel.y())) return false;
  }
  return true;
}

}  // namespace

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
    const TrackingResult result = tracker.track(ingest->process(images), nullptr, &timer);
    if (!result.has_targets) continue;
    const Points vertices = transformed(surface.rest_vertices, result.targets.body_pose);
    if (isWhollyShown(vertices, images.rectified)) return unit_m;
  }
  return std::nullopt;
}

}  // namespace softbody
