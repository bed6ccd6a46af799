#include "nodes/frame_poses.h"

#include <stdexcept>

#include "softbody_common/ros/geometry_messages.h"
#include "softbody_common/ros/time.h"

namespace softbody {

std::optional<StampedPose> FramePoses::find(const std::string& frame, const std::string& target_frame,
                                            const ros::Time& stamp) const {
  if (frame.empty() || frame == target_frame)
    return StampedPose{Eigen::Isometry3d::Identity(), toNanoseconds(stamp)};
  for (const ros::Time& time : {stamp, ros::Time()}) {  // time zero: the latest transform
    try {
      const auto transform = transforms_.buffer().lookupTransform(target_frame, frame, time);
      return StampedPose{fromMessage(transform.transform), toNanoseconds(transform.header.stamp)};
    } catch (const tf2::TransformException&) {
      continue;
    } catch (const std::invalid_argument& error) {
      ROS_WARN_STREAM_THROTTLE(5.0, "tf of frame " << frame << " is not used: " << error.what());
    }
  }
  return {};
}

bool FramePoses::knows(const std::string& frame, const std::string& target_frame) const {
  if (frame.empty()) return true;
  if (target_frame.empty()) return transforms_.buffer()._frameExists(frame);
  return find(frame, target_frame, ros::Time()).has_value();
}

}  // namespace softbody
