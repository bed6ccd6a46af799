#pragma once

#include <ros/ros.h>

#include <exception>

namespace softbody {

/// A node class as a process of its own. @return the exit code: 1, after a sentence, where it cannot start.
template <typename Node>
int runNode(int argc, char** argv, const char* name) {
  ros::init(argc, argv, name);
  try {
    const Node node(ros::NodeHandle(), ros::NodeHandle("~"));
    ros::spin();
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM(error.what());
    return 1;
  }
  return 0;
}

}  // namespace softbody
