#include "nodes/tool_tracker/tool_tracker_node.h"
#include "softbody_common/ros/run_node.h"

int main(int argc, char** argv) {
  return softbody::runNode<softbody::ToolTrackerNode>(argc, argv, "tool_tracker");
}
