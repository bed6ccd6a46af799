#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>

#include <functional>
#include <string>

namespace softbody {

/// Publishes a node's diagnostics every second of wall time. Its owner keeps it after all members that the
/// reports use.
class NodeDiagnostics {
 public:
  using Status = diagnostic_updater::DiagnosticStatusWrapper;
  using Report = std::function<void(Status& status)>;

  /// The status is named "<node>: <task>", with the node's own name even in a nodelet manager.
  /// @param hardware_id of what the node drives.
  NodeDiagnostics(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle,
                  const std::string& task, const Report& report, const std::string& hardware_id = "none");

  /// Adds one more status of the node.
  void add(const std::string& task, const Report& report) { updater_.add(task, report); }

 private:
  diagnostic_updater::Updater updater_;
  ros::WallTimer timer_;
};

}  // namespace softbody
