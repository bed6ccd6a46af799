#include "softbody_common/ros/node_nodelet.h"

#include <pluginlib/class_list_macros.hpp>

#include "nodes/camera_ingest/camera_ingest_node.h"
#include "nodes/feature_tracker/feature_tracker_node.h"
#include "nodes/pose_marker/pose_marker_node.h"
#include "nodes/tool_tracker/tool_tracker_node.h"

namespace softbody {

class CameraIngestNodelet : public NodeNodelet<CameraIngestNode> {};
class FeatureTrackerNodelet : public NodeNodelet<FeatureTrackerNode> {};
class PoseMarkerNodelet : public NodeNodelet<PoseMarkerNode> {};
class ToolTrackerNodelet : public NodeNodelet<ToolTrackerNode> {};

}  // namespace softbody

PLUGINLIB_EXPORT_CLASS(softbody::CameraIngestNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(softbody::FeatureTrackerNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(softbody::PoseMarkerNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(softbody::ToolTrackerNodelet, nodelet::Nodelet)
