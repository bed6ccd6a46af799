#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "motion/model_frame.h"
#include "softbody_tracking/rgbd_frame.h"
#include "softbody_tracking/tool/tool_tracker.h"

namespace softbody::scanning {

/// Where a frame was taken, and how sure this is.
struct CameraPose {
  Eigen::Isometry3d T_camera_model = Eigen::Isometry3d::Identity();
  PoseCovariance covariance = PoseCovariance::Zero();  ///< as that of a tool
};

/// Finds where the frames of one recording were taken. Frames come in the order of time.
class CameraMotion {
 public:
  virtual ~CameraMotion() = default;
  /// The frame's pose; nothing: it is not known, and reason() says why.
  virtual std::optional<CameraPose> poseOf(const RgbdFrame& frame) = 0;
  virtual std::string reason() const = 0;
  /// The model frame, once all frames were seen; the frame of the poses is moved into it.
  /// @throw std::invalid_argument if it cannot be found.
  virtual ModelFrame modelFrame(std::vector<KeyFrame>* frames) = 0;
};

}  // namespace softbody::scanning
