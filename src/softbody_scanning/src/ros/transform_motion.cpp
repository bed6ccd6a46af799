#include "ros/transform_motion.h"

#include <tf2/exceptions.h>

#include <utility>

#include "softbody_common/ros/time.h"
#include "softbody_scanning/fusion/depth_view.h"

namespace softbody::scanning {
namespace {

constexpr double kMoves_m = 0.05;

}  // namespace

TransformMotion::TransformMotion(const std::string& bag, std::string fixed_frame)
    : transforms_({bag}), fixed_frame_(std::move(fixed_frame)) {}

std::optional<CameraPose> TransformMotion::poseOf(const RgbdFrame& frame) {
  try {
    const ros::Time stamp = toTime(frame.stamp);
    if (fixed_frame_.empty()) fixed_frame_ = transforms_.rootOf(camera_frame_, stamp);
    reason_.clear();
    return CameraPose{transforms_.at(camera_frame_, fixed_frame_, stamp), PoseCovariance::Zero()};
  } catch (const tf2::TransformException& error) {
    reason_ = error.what();
    return std::nullopt;
  }
}

ModelFrame TransformMotion::modelFrame(std::vector<KeyFrame>* frames) {
  const ModelFrame found = findModelFrame(*frames, measureInverseDepthNoise(*frames));
  for (KeyFrame& frame : *frames) frame.T_camera_model = frame.T_camera_model * found.T_model_fixed.inverse();
  return found;
}

bool TransformMotion::moves(const std::vector<Nanoseconds>& stamps) const {
  std::optional<Eigen::Vector3d> first;
  for (const Nanoseconds stamp : stamps) {
    try {
      const std::string root = transforms_.rootOf(camera_frame_, toTime(stamp));
      const Eigen::Vector3d eye = transforms_.at(root, camera_frame_, toTime(stamp)).translation();
      if (!first) first = eye;
      if ((eye - *first).norm() > kMoves_m) return true;
    } catch (const tf2::TransformException&) {  // no pose at this time
    }
  }
  return false;
}

}  // namespace softbody::scanning
