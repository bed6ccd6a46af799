#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>

#include <functional>
#include <string>

namespace softbody {

/// Publishes one diagnostic task of a node every second of wall time.
class NodeDiagnostics {
 public:
  using Report = std::function<void(diagnostic_updater::DiagnosticStatusWrapper& status)>;

  /// The status is named "<node>: <task>", with the node's own name even in a nodelet manager.
  NodeDiagnostics(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle,
                  const std::string& task, const Report& report);

 private:
  diagnostic_updater::Updater updater_;
  ros::WallTimer timer_;
};

}  // namespace softbody
