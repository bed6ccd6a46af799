#pragma once

#include <ros/ros.h>

#include <exception>

namespace softbody {

/// Runs a node class as a process. @return the exit code: 1, with a log message, if it cannot start.
template <typename Node>
int runNode(int argc, char** argv, const char* name) {
  ros::init(argc, argv, name);
  // This handle outlives the node, because the last handle shuts down ROS and the log.
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
