#include "softbody_tracking/ros/nodes.h"

#include "nodes/camera_ingest/camera_ingest_node.h"
#include "nodes/feature_tracker/feature_tracker_node.h"
#include "nodes/pose_marker/pose_marker_node.h"
#include "nodes/tool_tracker/tool_tracker_node.h"

namespace softbody {

std::shared_ptr<void> makeCameraIngest(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle) {
  return std::make_shared<CameraIngestNode>(handle, private_handle);
}

std::shared_ptr<void> makeFeatureTracker(const ros::NodeHandle& handle,
                                         const ros::NodeHandle& private_handle) {
  return std::make_shared<FeatureTrackerNode>(handle, private_handle);
}

std::shared_ptr<void> makeToolTracker(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle) {
  return std::make_shared<ToolTrackerNode>(handle, private_handle);
}

std::shared_ptr<void> makePoseMarker(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle) {
  return std::make_shared<PoseMarkerNode>(handle, private_handle);
}

}  // namespace softbody
