#include "softbody_common/ros/run_node.h"
#include "softbody_tracking/ros/nodes.h"

int main(int argc, char** argv) {
  return softbody::runNode(argc, argv, "pose_marker", softbody::makePoseMarker);
}
