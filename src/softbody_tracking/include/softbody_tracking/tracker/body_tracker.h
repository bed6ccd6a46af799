#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "softbody_common/geometry/types.h"
#include "softbody_common/time/stage_timer.h"
#include "softbody_tracking/rgbd_frame.h"
#include "softbody_tracking/tracker/tracking_result.h"
#include "softbody_tracking/tracker_config.h"

namespace softbody {

/// Status of a frame that cannot be tracked. A tracked body stays in its place.
TrackingStatus skippedFrame(const TrackingStatus& last, const std::string& why);

/// The same, because the camera's pose in the output frame is unknown.
TrackingStatus skippedFrame(const TrackingStatus& last, const std::string& camera_frame,
                            const std::string& output_frame, const std::string& why);

/// Status while no image comes. A body that was found is lost. @param silence_s since the last image; empty:
/// none has come.
TrackingStatus withoutImages(const TrackingStatus& last, const std::optional<double>& silence_s);

/// Makes targets for the simulation from RGB-D frames and the last simulated state. It finds the body,
/// predicts it, follows its features and its depth, and rejects outliers and occluders. Measurements are
/// compared in the camera frame; poses are kept in the fixed frame, so the camera may move.
class BodyTracker {
 public:
  /// @param picture of the body, to which its texture coordinates refer: blue, green, red. With it the search
  /// tells poses of the same shape apart. Empty: not known.
  explicit BodyTracker(const TrackerConfig& config, const cv::Mat3b& picture = cv::Mat3b());
  ~BodyTracker();

  /// Sets the body's models. The same ones again change nothing. If they are the same body after an edit,
  /// tracking continues, and the next state must have their revision. Otherwise tracking starts again.
  /// @throw std::invalid_argument if the volume has no tet, or if a tet or a triangle names a missing vertex.
  void setTopologies(const TetTopology& volume, const MeshTopology& surface);
  /// Changes weights and limits for the next frames, not modes; what was learned is kept.
  void setConfig(const TrackerConfig& config);
  /// Whether the models are set.
  bool ready() const;
  /// Whether models are the present body after an edit: their revision is greater, and what remains of the
  /// vertices has the same places at rest.
  bool isEdit(const TetTopology& volume, const MeshTopology& surface) const;
  /// Replaces the picture, before the models of another body are set. Empty: not known.
  void setPicture(const cv::Mat3b& picture);

  /// To use the targets of a frame at once; the tracker goes on to learn from the frame afterwards. If
  /// track() throws then, they have been used all the same.
  using UseTargets = std::function<void(const TargetSet& targets)>;

  /// Tracks the body in one frame. A frame of another pass resets the tracker.
  /// @param volume newest state of the volume in the fixed frame; nullptr without one, also when the
  /// simulator has started again: the targets then have `reset`. If the states stay out for a second, the
  /// status is DEGRADED and says so.
  /// @param use is called once if the result has targets, with them.
  /// @throw std::invalid_argument unless colour and depth have the camera's size.
  TrackingResult track(const RgbdFrame& frame, const MeshState* volume, StageTimer* timer,
                       const UseTargets& use = {});

  /// Forgets everything but the models; also the pose of restart().
  void reset();

  /// Forgets everything but the models, and searches for the body near a rough pose.
  /// @param rough_pose rest frame in the fixed frame, wrong by at most a few centimetres and about 15
  /// degrees.
  /// @throw std::logic_error unless ready().
  void restart(const Eigen::Isometry3d& rough_pose);

  /// Forgets everything but the models, and tracks from this pose without a search: the status alone says
  /// whether the body is there. @param pose rest frame in the fixed frame.
  /// @throw std::logic_error unless ready().
  void placeAt(const Eigen::Isometry3d& pose);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace softbody
