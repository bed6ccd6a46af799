#include "nodes/simulator/frame_poses.h"

#include <tf2_eigen/tf2_eigen.h>

namespace softbody {

std::optional<Eigen::Isometry3d> FramePoses::find(const std::string& frame, const std::string& target_frame,
                                                  const ros::Time& stamp) const {
  if (frame.empty() || frame == target_frame) return Eigen::Isometry3d::Identity();
  for (const ros::Time& time : {stamp, ros::Time()}) {  // time zero: the latest transform
    try {
      return Eigen::Isometry3d(
          tf2::transformToEigen(buffer_.lookupTransform(target_frame, frame, time)).matrix());
    } catch (const tf2::TransformException& error) {
      if (time.isZero())
        ROS_WARN_STREAM_THROTTLE(5.0, "tf does not know frame " << frame << ": " << error.what());
    }
  }
  return {};
}

}  // namespace softbody
