#pragma once

#include "motion/camera_motion.h"

namespace softbody::scanning {

/// The camera's motion from a printed sheet of markers below the object. The sheet's frame is the model's:
/// origin in its middle, z up. A sheet on a turntable is no other case, since only the sheet's pose relative
/// to the camera counts.
class SheetMotion : public CameraMotion {
 public:
  /// @throw std::invalid_argument as ToolTracker.
  explicit SheetMotion(const ToolDescription& sheet);

  std::optional<CameraPose> poseOf(const RgbdFrame& frame) override;
  std::string reason() const override { return reason_; }
  /// The sheet's frame, and the space above the sheet.
  ModelFrame modelFrame(std::vector<KeyFrame>* frames) override;

 private:
  ToolTracker tracker_;
  std::string reason_;
};

}  // namespace softbody::scanning
