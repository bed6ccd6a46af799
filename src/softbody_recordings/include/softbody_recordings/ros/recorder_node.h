#pragma once

#include <actionlib/server/simple_action_server.h>
#include <ros/ros.h>
#include <softbody_msgs/RecordAction.h>

#include <atomic>
#include <cstdint>
#include <string>

namespace softbody {

class Parameters;
class TopicRecorder;

/// Records topics into a bag: the action ~record. As a nodelet it gets the images of its manager without a
/// connection. Parameter: ~min_free_mb.
class RecorderNode {
 public:
  /// @throw std::invalid_argument for a bad parameter.
  RecorderNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node);
  /// Ends a recording, and keeps it.
  ~RecorderNode();

 private:
  using Action = actionlib::SimpleActionServer<softbody_msgs::RecordAction>;

  RecorderNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node, Parameters parameters);

  void onGoal(const softbody_msgs::RecordGoalConstPtr& goal);
  std::string recordUntilEnd(const softbody_msgs::RecordGoal& goal, TopicRecorder* recorder);
  bool isStopped() const;
  void finish(const softbody_msgs::RecordResult& result);

  ros::NodeHandle node_;
  const std::uintmax_t least_free_bytes_;
  std::atomic<bool> ends_{false};
  Action action_;
};

}  // namespace softbody
