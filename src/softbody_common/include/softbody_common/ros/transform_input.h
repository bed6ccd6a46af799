#pragma once

#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <tf2_msgs/TFMessage.h>
#include <tf2_ros/buffer.h>

#include <map>
#include <string>

#include "softbody_common/timeline.h"

namespace softbody {

/// Receives /tf and /tf_static in a thread of its own. Transforms with an odd stamp are refused: in tf2 one
/// of them ends the process or hides all later transforms of its frame. When time jumps back, the transforms
/// of the pass before are forgotten.
class TransformInput {
 public:
  TransformInput();
  TransformInput(const TransformInput&) = delete;
  TransformInput& operator=(const TransformInput&) = delete;

  const tf2_ros::Buffer& buffer() const { return buffer_; }

 private:
  void add(const geometry_msgs::TransformStamped& transform);
  bool isNew(const geometry_msgs::TransformStamped& transform);

  tf2_ros::Buffer buffer_;
  std::map<std::string, Timeline> timelines_;  ///< by child frame
  int pass_ = 0;                               ///< greatest of the timelines
  ros::CallbackQueue queue_;
  ros::NodeHandle node_;
  // Last, so that callbacks end before the members that they use.
  ros::Subscriber moving_, fixed_;
  ros::AsyncSpinner spinner_;
};

}  // namespace softbody
