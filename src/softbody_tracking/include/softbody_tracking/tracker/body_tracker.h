#pragma once

#include <memory>
#include <string>
#include <vector>

#include "softbody_common/stage_timer.h"
#include "softbody_common/types.h"
#include "softbody_tracking/rgbd_frame.h"
#include "softbody_tracking/tracker_config.h"

namespace softbody {

/// A feature bound to the body, as seen in one frame.
struct TrackedFeature {
  int id = 0;
  Eigen::Vector2d pixel;      ///< (u, v) [px]
  Eigen::Vector3d position;   ///< measured, camera frame [m]
  Eigen::Vector3d reference;  ///< where it was measured when first seen, camera frame of now [m]
  double confidence = 0.0;    ///< 0..1
};

/// What one frame gave.
struct TrackingResult {
  bool has_targets = false;  ///< false: nothing to simulate (waiting, or nothing was found)
  TargetSet targets;         ///< fixed frame
  std::vector<TrackedFeature> features;
  TrackingStatus status;
};

/// What to say of a frame that is not tracked since nothing tells where the camera is in the output frame: a
/// body that is tracked stays where it is.
TrackingStatus skippedFrame(const TrackingStatus& last, const std::string& camera_frame,
                            const std::string& output_frame, const std::string& why);

/// From RGB-D frames and the last simulated state to targets: registration, ORB features bound in rest space,
/// depth points on the visible surface, outliers and occluders rejected. What is seen is compared in the
/// camera's frame; what lasts from frame to frame is kept in the fixed one, so that the camera may move.
class BodyTracker {
 public:
  explicit BodyTracker(const TrackerConfig& config);
  ~BodyTracker();

  /// The body's models. With a greater revision than before they are the same body, cut: it is tracked on,
  /// and the next state must be of that revision. Otherwise tracking starts anew.
  /// @throw std::invalid_argument if the volume has no tet, or a tet or a triangle of either names a vertex
  /// that is not there.
  void setTopologies(const TetTopology& volume, const MeshTopology& surface);
  bool ready() const;

  /// Colour and depth have the camera's size. @throw std::invalid_argument otherwise.
  /// @param volume the newest state of the volume in the fixed frame, nullptr where there is none yet.
  TrackingResult track(const RgbdFrame& frame, const MeshState* volume, StageTimer* timer);

  /// Forgets everything seen, and restart(); topologies stay.
  void reset();

  /// Forgets everything seen and looks for the body near a rough pose (a few centimetres, some 15 degrees) of
  /// its rest frame in the fixed frame. @throw std::logic_error unless ready().
  void restart(const Eigen::Isometry3d& rough_pose);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace softbody
