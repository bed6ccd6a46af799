#pragma once

#include <memory>

#include "markerless/pose_refinement.h"
#include "motion/camera_motion.h"

namespace softbody::scanning {

/// The camera's motion without any marker: frame by frame from texture and depth, then all key frames
/// together. Nothing but the camera may move.
class MarkerlessMotion : public CameraMotion {
 public:
  MarkerlessMotion();
  ~MarkerlessMotion() override;

  /// The pose in the first frame's camera, drifting. A frame that is not sure has none; later frames are
  /// recognised by earlier ones.
  std::optional<CameraPose> poseOf(const RgbdFrame& frame) override;
  std::string reason() const override;
  /// Refines the poses, finds the table and moves the frames there.
  ModelFrame modelFrame(std::vector<KeyFrame>* frames) override;
  /// What modelFrame() found out.
  const RefinementReport& refinement() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace softbody::scanning
