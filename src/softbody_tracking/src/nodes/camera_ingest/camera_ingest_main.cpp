#include "nodes/camera_ingest/camera_ingest_node.h"
#include "softbody_common/ros/run_node.h"

int main(int argc, char** argv) {
  return softbody::runNode<softbody::CameraIngestNode>(argc, argv, "camera_ingest");
}
