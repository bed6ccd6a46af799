#pragma once

#include <ros/callback_queue.h>
#include <ros/ros.h>

namespace softbody {

/// Calls back in a thread of its own, for answers that take long.
struct OwnThread {
  /// @param parent gives the namespace.
  explicit OwnThread(const ros::NodeHandle& parent) : node(parent), spinner(1, &queue) {
    node.setCallbackQueue(&queue);
  }

  ros::CallbackQueue queue;
  ros::NodeHandle node;
  ros::AsyncSpinner spinner;
};

}  // namespace softbody
