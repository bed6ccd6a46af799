#include "softbody_common/ros/run_node.h"

#include <ros/ros.h>

#include <exception>

namespace softbody {

int runNode(int argc, char** argv, const char* name, NodeMaker make) {
  ros::init(argc, argv, name);
  // This handle outlives the node, because the last handle shuts down ROS and the log.
  const ros::NodeHandle handle;
  try {
    const std::shared_ptr<void> node = make(handle, ros::NodeHandle("~"));
    ros::spin();
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM(error.what());
    return 1;
  }
  return 0;
}

}  // namespace softbody
