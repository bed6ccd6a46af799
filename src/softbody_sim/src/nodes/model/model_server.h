#pragma once

#include <actionlib/server/simple_action_server.h>
#include <ros/ros.h>
#include <softbody_msgs/PrepareModelAction.h>

#include <atomic>

namespace softbody {

/// Makes object folders from meshes: the action ~prepare_model.
class ModelServer {
 public:
  ModelServer(const ros::NodeHandle& node, const ros::NodeHandle& private_node);
  /// Ends the work that runs; its folder stays as it was.
  ~ModelServer();

 private:
  using Action = actionlib::SimpleActionServer<softbody_msgs::PrepareModelAction>;

  void onGoal(const softbody_msgs::PrepareModelGoalConstPtr& goal);
  softbody_msgs::PrepareModelResult prepare(const softbody_msgs::PrepareModelGoal& goal);
  void tell(double share, double* told);

  std::atomic<bool> ends_{false};
  Action action_;
};

}  // namespace softbody
