#include "nodes/simulator/frame_poses.h"

#include <tf2_eigen/tf2_eigen.h>

namespace softbody {

std::optional<FramePoses::StampedPose> FramePoses::find(const std::string& frame,
                                                        const std::string& target_frame,
                                                        const ros::Time& stamp) const {
  if (frame.empty() || frame == target_frame) return StampedPose{Eigen::Isometry3d::Identity(), stamp};
  for (const ros::Time& time : {stamp, ros::Time()}) {  // time zero: the latest transform
    try {
      const auto transform = transforms_.buffer().lookupTransform(target_frame, frame, time);
      return StampedPose{Eigen::Isometry3d(tf2::transformToEigen(transform).matrix()),
                         transform.header.stamp};
    } catch (const tf2::TransformException&) {
      continue;
    }
  }
  return {};
}

}  // namespace softbody
