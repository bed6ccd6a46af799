#pragma once

#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <functional>
#include <memory>
#include <string>

#include "fuzz/messages/lone_master.h"

namespace softbody::fuzz {

/// ROS inside of this process: no roscore is needed. Time is simulated, and goes on only by hand.
class LoneRos {
 public:
  /// The one of this process.
  static LoneRos& instance();

  LoneMaster& master() { return master_; }

  /// Ends ROS; the static objects of roscpp cannot do it by themselves.
  static void end() { ros::shutdown(); }

  /// Time goes on; below 0: it jumps back.
  void advance(double seconds);
  ros::Time now() const { return now_; }

 private:
  LoneRos();

  LoneMaster master_;
  ros::Time now_{1000.0};
};

/// A node whose callbacks run only in process().
class DrivenNode {
 public:
  using Make = std::function<std::shared_ptr<void>(const ros::NodeHandle& handle,
                                                   const ros::NodeHandle& private_handle)>;

  /// @param parameters private ones of the node.
  DrivenNode(const std::string& name, const XmlRpc::XmlRpcValue& parameters, const Make& make);
  ~DrivenNode();
  DrivenNode(const DrivenNode&) = delete;
  DrivenNode& operator=(const DrivenNode&) = delete;

  /// Of the topics beside the node. Subscribers called in process(), too.
  ros::NodeHandle& handle() { return handle_; }
  /// Of the node's services.
  ros::NodeHandle& privateHandle() { return private_handle_; }

  /// Runs all callbacks that wait.
  void process();
  /// Runs callbacks until a condition holds. @return false: not within 10 s.
  bool processUntil(const std::function<bool()>& condition);

 private:
  ros::CallbackQueue callbacks_;
  ros::NodeHandle handle_, private_handle_;
  std::shared_ptr<void> node_;
};

}  // namespace softbody::fuzz
