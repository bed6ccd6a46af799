#include "tracker/body_placement.h"

#include <vector>

namespace softbody {
namespace {

constexpr int kLostFramesBeforeRecovery = 10;
constexpr int kFramesBetweenRegistrations = 10;  // it takes about a second

}  // namespace

void BodyPlacement::reset() {
  fresh_ = true;
  registered_ = recovering_ = false;
  given_.reset();
  lost_frames_ = frames_to_registration_ = frames_to_recognition_ = 0;
}

void BodyPlacement::startNear(const Eigen::Isometry3d& rough_pose) {
  fresh_ = false;
  given_ = pose_ = rough_pose;
}

BodyPlacement::Found BodyPlacement::find(const RgbdFrame& frame, FrameObserver* observer, StageTimer* timer) {
  if (fresh_) takeInitialPose(frame, observer->surface().volume());
  if (lost_frames_ >= kLostFramesBeforeRecovery) {
    registered_ = false;
    recovering_ = true;
    lost_frames_ = 0;
  }
  if (recovering_ && recognize(frame, observer, timer)) return Found::kAnew;
  if (registered_) return Found::kBefore;
  return start(frame, observer, timer) ? Found::kAnew : Found::kNowhere;
}

void BodyPlacement::heed(bool lost) {
  lost_frames_ = lost ? lost_frames_ + 1 : 0;
  recovering_ = recovering_ && lost;
}

/// The object's file says where the body is before the camera as it stands at the start.
void BodyPlacement::takeInitialPose(const RgbdFrame& frame, const TetTopology& volume) {
  pose_ = frame.T_fixed_camera * volume.initial_pose;
  if (volume.has_initial_pose) given_ = pose_;
  fresh_ = false;
}

const Localizer& BodyPlacement::localizerOf(const MeshTopology& surface) {
  if (localizer_ == nullptr) {
    localizer_ = std::make_unique<Localizer>(TriangleMesh{surface.rest_vertices, surface.triangles}, config_);
  }
  return *localizer_;
}

void BodyPlacement::place(const RgbdFrame& frame, const Localization& found) {
  pose_ = frame.T_fixed_camera * found.pose;
  alike_ = found.alike;
  registered_ = true;
  lost_frames_ = frames_to_registration_ = frames_to_recognition_ = 0;
  since_ = frame.stamp;
}

/// Finds a body that was lost by its features, as soon as they are seen again.
bool BodyPlacement::recognize(const RgbdFrame& frame, FrameObserver* observer, StageTimer* timer) {
  if (frames_to_recognition_-- > 0) return false;
  const std::optional<Eigen::Isometry3d> rough = observer->recognize(frame);
  frames_to_recognition_ = rough ? kFramesBetweenRegistrations : 0;
  if (!rough) return false;
  const auto scope = timer->stage("Model Registration", true);
  const std::optional<Localization> found =
      localizerOf(observer->surface().topology())
          .recognized(frame, *rough,
                      [&](const Eigen::Isometry3d& pose) { return observer->featureShare(frame, pose); });
  if (found) place(frame, *found);
  return found.has_value();
}

/// Finds the body where nothing predicts it: near the pose that the user gave, or anywhere.
bool BodyPlacement::start(const RgbdFrame& frame, FrameObserver* observer, StageTimer* timer) {
  if (frames_to_registration_-- > 0) return false;
  frames_to_registration_ = kFramesBetweenRegistrations;
  const auto scope = timer->stage("Model Registration", true);
  const Localizer& localizer = localizerOf(observer->surface().topology());
  const Eigen::Isometry3d T_camera_fixed = frame.T_fixed_camera.inverse();
  std::optional<Localization> found;
  if (given_ && !recovering_) found = localizer.near(frame, T_camera_fixed * *given_);
  if (!found) {
    std::vector<Eigen::Isometry3d> guesses;
    if (recovering_ || given_) guesses.push_back(T_camera_fixed * pose_);
    found = localizer.anywhere(frame, observer->colors(), guesses, [&](const Eigen::Isometry3d& pose) {
      return observer->featureShare(frame, pose);
    });
  }
  if (found) place(frame, *found);
  return found.has_value();
}

}  // namespace softbody
