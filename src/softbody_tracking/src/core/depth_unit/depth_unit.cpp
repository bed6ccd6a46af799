#include "softbody_tracking/depth_unit/depth_unit.h"

#include <cmath>

#include "softbody_common/camera_topics.h"
#include "softbody_common/rigid_fit.h"
#include "softbody_tracking/tracker/body_tracker.h"

namespace softbody {
namespace {

// Of the vertices: where most of the outline is outside of the image, any wall would fit.
constexpr double kShown = 0.9;

/// Share of the vertices that are within the image. @param vertices camera frame [m].
double shownShare(const Points& vertices, const Pinhole& camera) {
  Eigen::Index shown = 0;
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
    const Eigen::Vector3d point = vertices.row(v);
    if (point.z() <= 0.0) continue;
    const Eigen::Vector2d pixel = camera.project(point);
    shown += pixel.x() >= 0.0 && pixel.x() < camera.width && pixel.y() >= 0.0 && pixel.y() < camera.height;
  }
  return static_cast<double>(shown) / static_cast<double>(vertices.rows());
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
    if (shownShare(vertices, images.rectified) >= kShown) return unit_m;
  }
  return std::nullopt;
}

}  // namespace softbody
