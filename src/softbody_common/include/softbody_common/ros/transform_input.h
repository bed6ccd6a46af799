#pragma once

#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <tf2_msgs/TFMessage.h>
#include <tf2_ros/buffer.h>

#include <map>
#include <mutex>
#include <set>
#include <string>

#include "softbody_common/time/timeline.h"

namespace softbody {

/// Receives /tf and /tf_static in a thread of its own. Transforms with an odd stamp are refused: in tf2 one
/// of them ends the process or hides all later transforms of its frame. When time jumps back, the transforms
/// of the pass before are forgotten. The number of frames and the length of their names are bounded.
class TransformInput {
 public:
  TransformInput();
  TransformInput(const TransformInput&) = delete;
  TransformInput& operator=(const TransformInput&) = delete;

  const tf2_ros::Buffer& buffer() const { return buffer_; }

  /// Warns when another node sends the transform of a frame that this node sends. Call it once.
  void claim(const std::string& frame);

  /// Why tf has no transform between two frames at any time, as a sentence: which frame it does not know, or
  /// which two trees are not connected. Empty: it has one, only not at every time.
  std::string whyMissing(const std::string& target, const std::string& source) const;

 private:
  struct Child {
    Timeline timeline;
    RefusedStamps refused;
    int clears = -1;  ///< clears_ when its last transform was accepted
  };
  void onMoving(const ros::MessageEvent<const tf2_msgs::TFMessage>& event);
  void add(const geometry_msgs::TransformStamped& transform, bool is_fixed);
  std::string rootOf(std::string frame) const;
  void admit(const std::string& frame);
  static void warnOfRefused(const std::string& frame, const std::string& why);
  bool isNew(const geometry_msgs::TransformStamped& transform);

  tf2_ros::Buffer buffer_;
  std::set<std::string> frames_;           ///< parents and children that tf2 knows
  std::map<std::string, Child> children_;  ///< of moving transforms
  int clears_ = 0;                         ///< of the buffer
  std::mutex claim_mutex_;
  std::string claimed_;  ///< frame that this node sends; empty: none
  ros::CallbackQueue queue_;
  ros::NodeHandle node_;
  // Last, so that callbacks end before the members that they use.
  ros::Subscriber moving_, fixed_;
  ros::AsyncSpinner spinner_;
};

}  // namespace softbody
