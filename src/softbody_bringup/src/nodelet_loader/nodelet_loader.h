#pragma once

#include <ros/ros.h>

#include <string>

namespace softbody {

/// Keeps one nodelet loaded in a manager: loads it again whenever the manager has started again. The name of
/// this node is the name of the nodelet. `nodelet load` waits four seconds before it notices that its manager
/// is dead. A lost connection is noticed at once.
class NodeletLoader {
 public:
  NodeletLoader(std::string type, const std::string& manager);

  /// Works until SIGINT, SIGTERM or a shutdown by the master, then unloads the nodelet.
  /// @return the exit code: 1, with a log message, if the nodelet does not start.
  int run();

 private:
  /// @return whether a manager answers; false only at the end.
  bool connect();
  bool managerHasNodelet();
  bool load();
  void watch() const;
  void unload();

  ros::NodeHandle handle_;
  std::string name_, type_, manager_;
  ros::ServiceClient session_;  ///< a connection that lasts as long as the manager's process
};

}  // namespace softbody
