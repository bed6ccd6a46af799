#include "softbody_common/ros/run_node.h"

#include <ros/ros.h>

#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "softbody_common/package_version.h"

namespace softbody {

int runNode(int argc, char** argv, const char* name, NodeMaker make) {
  std::vector<std::string> words;
  ros::removeROSArgs(argc, argv, words);
  if (words.size() == 2 && (words[1] == "--help" || words[1] == "-h")) {
    std::printf(
        "A node. Usage: %s [_PARAMETER:=VALUE] [TOPIC:=OTHER_TOPIC]\n--version prints package and version\n",
        name);
    return 0;
  }
  if (words.size() == 2 && words[1] == "--version") {
    std::printf("%s\n", packageVersion().c_str());
    return 0;
  }
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
