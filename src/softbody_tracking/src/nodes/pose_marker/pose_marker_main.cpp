#include "nodes/pose_marker/pose_marker_node.h"
#include "softbody_common/ros/run_node.h"

int main(int argc, char** argv) {
  return softbody::runNode<softbody::PoseMarkerNode>(argc, argv, "pose_marker");
}
