#include <ros/ros.h>

#include <cstdio>
#include <string>
#include <vector>

#include "nodelet_loader/nodelet_loader.h"
#include "softbody_common/ros/run_node.h"
#include "softbody_common/tools/package_version.h"

int main(int argc, char** argv) {
  std::vector<std::string> arguments;
  ros::removeROSArgs(argc, argv, arguments);
  if (arguments.size() == 2 && arguments[1] == "--version") {
    std::printf("%s\n", softbody::packageVersion().c_str());
    return 0;
  }
  if (arguments.size() != 3) {
    std::fputs("usage: nodelet_loader PACKAGE/TYPE MANAGER\n", stderr);
    return 2;
  }
  softbody::logLineByLine();
  ros::init(argc, argv, "nodelet_loader", ros::init_options::NoSigintHandler);
  // This handle outlives the loader, because the last handle shuts down ROS.
  const ros::NodeHandle handle;
  return softbody::NodeletLoader(arguments[1], arguments[2]).run();
}
