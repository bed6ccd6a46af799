#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <optional>

#include "registration/localizer.h"
#include "softbody_common/stage_timer.h"
#include "tracker/frame_observer.h"

namespace softbody {

/// Where the body is in frames in which nothing predicts it: at the start, and after it was lost.
class BodyPlacement {
 public:
  enum class Found { kNowhere, kAnew, kBefore };

  explicit BodyPlacement(const RegistrationConfig& config) : config_(config) {}

  /// Forgets where the body is.
  void reset();
  /// After reset(): looks near a rough pose in the fixed frame, not where the object's file says.
  void startNear(const Eigen::Isometry3d& rough_pose);
  /// The body's models have changed.
  void forgetModels() { localizer_.reset(); }

  /// Looks for the body unless it is followed. @param observer knows its models, features and colours.
  Found find(const RgbdFrame& frame, FrameObserver* observer, StageTimer* timer);

  /// Whether a followed body was lost in this frame; after some on end it is looked for again.
  void heed(bool lost);
  /// Where it is followed to.
  void follow(const Eigen::Isometry3d& pose) { pose_ = pose; }

  /// Of the rest shape in the fixed frame.
  const Eigen::Isometry3d& pose() const { return pose_; }
  bool recovering() const { return recovering_; }
  int alike() const { return alike_; }          ///< poses that explained the frame in which it was found
  Nanoseconds since() const { return since_; }  ///< stamp of that frame

 private:
  void takeInitialPose(const RgbdFrame& frame, const TetTopology& volume);
  bool start(const RgbdFrame& frame, FrameObserver* observer, StageTimer* timer);
  bool recognize(const RgbdFrame& frame, FrameObserver* observer, StageTimer* timer);
  const Localizer& localizerOf(const MeshTopology& surface);
  void place(const RgbdFrame& frame, const Localization& found);

  RegistrationConfig config_;
  std::unique_ptr<Localizer> localizer_;  ///< null until it is needed: no frame waits for it after a cut
  bool fresh_ = true;                     ///< no frame since the last reset
  bool registered_ = false;
  bool recovering_ = false;
  int alike_ = 1;
  std::optional<Eigen::Isometry3d> given_;  ///< rough, by the object's file or the user; fixed frame
  Eigen::Isometry3d pose_ = Eigen::Isometry3d::Identity();
  Nanoseconds since_ = 0;
  int lost_frames_ = 0;
  int frames_to_registration_ = 0;
  int frames_to_recognition_ = 0;  ///< after one that registration refused
};

}  // namespace softbody
