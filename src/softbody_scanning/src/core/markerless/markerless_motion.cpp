#include "markerless/markerless_motion.h"

#include <algorithm>

#include "markerless/certainty.h"
#include "markerless/recognition.h"
#include "softbody_scanning/fusion/depth_view.h"

namespace softbody::scanning {
namespace {

// A new frame is remembered after this motion: neighbours then overlap by far.
constexpr double kTurn_rad = 0.06, kWay_m = 0.03;
constexpr int kRecognisedPerFrame = 8;  // remembered frames that one lost frame is compared with

bool isFar(const Eigen::Isometry3d& motion) {
  return Eigen::AngleAxisd(motion.linear()).angle() > kTurn_rad || motion.translation().norm() > kWay_m;
}

}  // namespace

class MarkerlessMotion::Implementation {
 public:
  std::optional<CameraPose> poseOf(const RgbdFrame& frame) {
    reason = "nothing is seen";
    const double depth_m = medianDepth(frame.depth);
    if (!(depth_m > 0.0)) return lost();
    if (memory_.empty()) return begin(frame);
    TrackedFrame now = followedFrame(frame.camera, frame.color, frame.depth);
    std::optional<CameraPose> pose;
    if (!lost_)
      pose = fromReference(now, depth_m, velocity_ * last_ * reference_pose_.T_camera_model.inverse());
    if (!pose) pose = recognised(frame, now, depth_m);
    if (!pose) return lost();
    reason.clear();
    velocity_ = lost_ ? Eigen::Isometry3d::Identity() : pose->T_camera_model * last_.inverse();
    lost_ = false;
    last_ = pose->T_camera_model;
    if (isFar(last_ * reference_pose_.T_camera_model.inverse())) remember(frame, std::move(now), *pose);
    return pose;
  }

  std::string reason;
  RefinementReport refinement;

 private:
  /// A frame that others are compared with.
  struct Remembered {
    cv::Mat3b color;
    cv::Mat1f depth;
    FrameLook look;
    CameraPose pose;
  };

  std::optional<CameraPose> lost() {
    lost_ = true;
    return std::nullopt;
  }

  CameraPose begin(const RgbdFrame& frame) {
    inverse_depth_std_ = measureInverseDepthNoise({{frame.stamp, frame.camera, frame.color, frame.depth}});
    remember(frame, followedFrame(frame.camera, frame.color, frame.depth), {});
    reason.clear();
    return {};
  }

  void remember(const RgbdFrame& frame, TrackedFrame now, const CameraPose& pose) {
    memory_.push_back({frame.color, frame.depth, lookOf(frame.camera, frame.color, frame.depth), pose});
    reference_ = std::move(now);
    addAnchors(inverse_depth_std_, &reference_);
    reference_pose_ = pose;
  }

  std::optional<CameraPose> fromReference(const TrackedFrame& now, double depth_m,
                                          const Eigen::Isometry3d& T_now_reference) {
    const RelativePose found = estimateRelativePose(reference_, now, T_now_reference, inverse_depth_std_);
    reason = doubtAbout(found, depth_m, inverse_depth_std_);
    if (!reason.empty()) return std::nullopt;
    const PoseCovariance A = movedBy(found.T_to_from);
    return CameraPose{found.T_to_from * reference_pose_.T_camera_model,
                      found.covariance + A * reference_pose_.covariance * A.transpose()};
  }

  /// Compares the frame with the last remembered one and some of the others in turn.
  std::optional<CameraPose> recognised(const RgbdFrame& frame, const TrackedFrame& now, double depth_m) {
    const FrameLook look = lookOf(frame.camera, frame.color, frame.depth);
    const std::size_t count = memory_.size();
    for (std::size_t i = 0; i < std::min<std::size_t>(count, kRecognisedPerFrame); ++i) {
      const Remembered& old = memory_[i == 0 ? count - 1 : ++turn_ % count];
      const auto T_now_old = recognise(old.look, look);
      if (!T_now_old) continue;
      reference_ = followedFrame(frame.camera, old.color, old.depth);
      addAnchors(inverse_depth_std_, &reference_);
      reference_pose_ = old.pose;
      if (auto pose = fromReference(now, depth_m, *T_now_old)) return pose;
    }
    if (reason.empty()) reason = "no earlier frame shows the same";
    return std::nullopt;
  }

  double inverse_depth_std_ = 0.0;
  std::vector<Remembered> memory_;
  TrackedFrame reference_;
  CameraPose reference_pose_;
  Eigen::Isometry3d last_ = Eigen::Isometry3d::Identity(), velocity_ = Eigen::Isometry3d::Identity();
  bool lost_ = false;
  std::size_t turn_ = 0;
};

MarkerlessMotion::MarkerlessMotion() : implementation_(std::make_unique<Implementation>()) {}
MarkerlessMotion::~MarkerlessMotion() = default;

std::optional<CameraPose> MarkerlessMotion::poseOf(const RgbdFrame& frame) {
  return implementation_->poseOf(frame);
}

std::string MarkerlessMotion::reason() const { return implementation_->reason; }

const RefinementReport& MarkerlessMotion::refinement() const { return implementation_->refinement; }

ModelFrame MarkerlessMotion::modelFrame(std::vector<KeyFrame>* frames) {
  implementation_->refinement = refinePoses(frames);
  const ModelFrame found = findModelFrame(*frames, measureInverseDepthNoise(*frames));
  for (KeyFrame& frame : *frames) frame.T_camera_model = frame.T_camera_model * found.T_model_fixed.inverse();
  return found;
}

}  // namespace softbody::scanning
