#include "ros/replay/camera_poses.h"

#include "softbody_common/ros/frame_name.h"

namespace softbody {

CameraPoses::CameraPoses(const std::string& bag, const std::string& output_frame)
    : output_frame_(withoutSlash(output_frame)) {
  if (!output_frame_.empty()) transforms_.emplace(std::vector<std::string>{bag});
}

Eigen::Isometry3d CameraPoses::of(const std_msgs::Header& header) const {
  if (!transforms_) return Eigen::Isometry3d::Identity();
  return transforms_->at(output_frame_, header.frame_id, header.stamp);
}

std::vector<std::string> CameraPoses::warnings() const {
  return transforms_ ? transforms_->warnings() : std::vector<std::string>();
}

}  // namespace softbody
