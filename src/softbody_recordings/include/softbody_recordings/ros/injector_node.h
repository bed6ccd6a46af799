#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/subscriber.h>
#include <ros/timer.h>

#include <memory>
#include <optional>

#include "softbody_common/ros/node_diagnostics.h"

namespace softbody::injection {

class LiveStream;

/// Adds faults to a live camera: reads camera/..., publishes camera_faulty/.... The same seed gives the same
/// faults as in a bag. Parameters: injectorParameters().
class InjectorNode {
 public:
  /// @throw std::invalid_argument for a bad parameter.
  InjectorNode(ros::NodeHandle handle, const ros::NodeHandle& private_handle);
  ~InjectorNode();

 private:
  void relayInfos(ros::NodeHandle* handle);
  void diagnose(NodeDiagnostics::Status& status);

  std::unique_ptr<LiveStream> color_, depth_;
  ros::Publisher color_info_, depth_info_;
  ros::Subscriber color_info_subscriber_, depth_info_subscriber_;
  std::optional<NodeDiagnostics> diagnostics_;
};

}  // namespace softbody::injection
