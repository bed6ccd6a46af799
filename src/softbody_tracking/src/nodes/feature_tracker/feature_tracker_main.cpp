#include "nodes/feature_tracker/feature_tracker_node.h"
#include "softbody_common/ros/run_node.h"

int main(int argc, char** argv) {
  return softbody::runNode<softbody::FeatureTrackerNode>(argc, argv, "feature_tracker");
}
