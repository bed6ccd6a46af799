#pragma once

#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <functional>
#include <memory>
#include <set>
#include <string>

namespace softbody::fuzz {

/// ROS for this process alone, with a master that ends with it. Time is simulated, and goes on only by hand.
class LoneRos {
 public:
  /// The one of this process.
  static LoneRos& instance();

  /// Ends ROS; the static objects of roscpp cannot do it by themselves.
  static void end() { ros::shutdown(); }

  /// Time goes on; below 0: it jumps back.
  void advance(double seconds);
  ros::Time now() const { return now_; }

  /// Inputs of nodes, as "NODE INPUT": those that nodes have at their start, and those that are fuzzed.
  std::set<std::string> heard, fuzzed;

 private:
  LoneRos();

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

  const std::string& name() const { return private_handle_.getNamespace(); }

  /// Of the topics beside the node. Subscribers called in process(), too.
  ros::NodeHandle& handle() { return handle_; }
  /// Of the node's services.
  ros::NodeHandle& privateHandle() { return private_handle_; }

  /// Notes that a topic or service is fuzzed.
  void noteFuzzed(const std::string& input);

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
