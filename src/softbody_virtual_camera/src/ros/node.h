#pragma once

#include <image_transport/image_transport.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/timer.h>

#include <map>
#include <optional>
#include <string>

#include "ros/render_ahead.h"
#include "softbody_common/ros/node_diagnostics.h"
#include "softbody_virtual_camera/ros/node_options.h"

namespace softbody::virtual_camera {

/// The virtual camera as a node. Parameters: nodeParameters(). Publishes the camera's topics (camera/...),
/// the truth (ground_truth/...) and optical frame -> ground_truth_softbody. Each frame is rendered just
/// before its time comes, and gets its stamp when it is sent, as from a real camera.
class VirtualCameraNode {
 public:
  /// @param setup defaults of the parameters.
  VirtualCameraNode(ros::NodeHandle node, const ros::NodeHandle& private_node, const CameraSetup& setup);

 private:
  double sceneTime(int frame) const;
  CaptureMessages render(int frame);
  void advertise(ros::NodeHandle node, const std::string& name_space);
  bool hasSubscribers() const;
  void publishLatched(std::uint32_t revision, const ros::Time& stamp);
  void onTimer(const ros::TimerEvent& event);
  void publish(const CaptureMessages& messages, const ros::Time& stamp);
  void diagnose(NodeDiagnostics::Status& status);

  NodeOptions options_;
  std::optional<VirtualCamera> camera_;
  image_transport::Publisher color_, depth_, truth_labels_;
  ros::Publisher color_info_, depth_info_, truth_topology_, truth_state_, second_topology_, second_state_,
      truth_camera_, truth_forces_, truth_tool_, truth_cut_, truth_material_, gripper_, tf_, tf_static_;
  std::map<std::string, ros::Publisher> wrenches_, true_wrenches_;  ///< by the name of the thing
  ros::Timer timer_;
  int frame_ = 0;
  std::uint32_t revision_ = 0;
  bool over_ = false;             ///< the scene, without loop
  int published_ = 0, late_ = 0;  ///< frames since the last diagnosis, and those sent a frame's time too late
  ros::WallTime last_diagnosis_ = ros::WallTime::now();
  std::optional<RenderAhead> ahead_;  ///< near the end, because its thread uses the members above
  std::optional<NodeDiagnostics> diagnostics_;
};

/// The camera's setup with the files that softbody_bringup ships.
CameraSetup shippedSetup();

/// Runs a VirtualCameraNode until shutdown. @return the exit code.
int runNode(int argc, char** argv, const CameraSetup& setup);

}  // namespace softbody::virtual_camera
