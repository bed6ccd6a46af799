#pragma once

#include <ros/ros.h>

#include <exception>

namespace softbody {

/// A node class as a process of its own. @return the exit code: 1, after a sentence, where it cannot start.
template <typename Node>
int runNode(int argc, char** argv, const char* name) {
  ros::init(argc, argv, name);
  // Outlives the node: with the last handle ROS shuts down, and with it the log.
  const ros::NodeHandle handle;
  try {
    const Node node(handle, ros::NodeHandle("~"));
    ros::spin();
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM(error.what());
    return 1;
  }
  return 0;
}

}  // namespace softbody
