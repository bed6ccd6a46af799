#pragma once

#include <string>
#include <vector>

#include "motion/camera_motion.h"
#include "softbody_recordings/ros/bag_transforms.h"

namespace softbody::scanning {

/// The motion of a camera on an arm, from the /tf of its recording.
class TransformMotion : public CameraMotion {
 public:
  /// @param fixed_frame empty: the frame that has no parent above the camera's.
  TransformMotion(const std::string& bag, std::string fixed_frame);

  /// To be called before poseOf(): the camera's frame.
  void setCameraFrame(const std::string& frame) { camera_frame_ = frame; }
  std::optional<CameraPose> poseOf(const RgbdFrame& frame) override;
  std::string reason() const override { return reason_; }
  ModelFrame modelFrame(std::vector<KeyFrame>* frames) override;
  /// Whether the camera moves between any of these times.
  bool moves(const std::vector<Nanoseconds>& stamps) const;

 private:
  BagTransforms transforms_;
  std::string fixed_frame_, camera_frame_, reason_;
};

}  // namespace softbody::scanning
