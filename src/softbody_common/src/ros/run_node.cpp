#include "softbody_common/ros/run_node.h"

#include <malloc.h>
#include <ros/ros.h>

#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "softbody_common/tools/package_version.h"

namespace softbody {
namespace {

/// glibc's own limits grow only up to the size of one image.
void setLimits(FreedMemory freed) {
  constexpr int kLargestBlock = 32 << 20;  // glibc's largest threshold; an image of 3840x2160 in metres
  constexpr int kLargeArray = 1 << 18;     // [bytes]
  const int block = freed == FreedMemory::kReturned ? kLargeArray : kLargestBlock;
  mallopt(M_MMAP_THRESHOLD, block);
  mallopt(M_TRIM_THRESHOLD, 2 * block);  // glibc's own ratio
}

}  // namespace

// rosconsole has read ROSCONSOLE_STDOUT_LINE_BUFFERED before main.
void logLineByLine() { std::setvbuf(stdout, nullptr, _IOLBF, 0); }

int runNode(int argc, char** argv, const char* name, NodeMaker make, FreedMemory freed) {
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
  setLimits(freed);
  logLineByLine();
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
