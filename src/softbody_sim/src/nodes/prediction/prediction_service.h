#pragma once

#include <actionlib/server/simple_action_server.h>
#include <ros/ros.h>
#include <softbody_msgs/Predict.h>
#include <softbody_msgs/PredictPlansAction.h>

#include "nodes/own_thread.h"
#include "nodes/prediction/plan_predictor.h"

namespace softbody {

/// The service ~predict and the action ~predict_plans. They answer in threads of their own.
class PredictionService {
 public:
  /// @param find_present as PlanPredictor's.
  PredictionService(const ros::NodeHandle& node, ros::NodeHandle private_node,
                    PlanPredictor::FindPresent find_present);
  ~PredictionService();

 private:
  using Action = actionlib::SimpleActionServer<softbody_msgs::PredictPlansAction>;

  void onGoal(const softbody_msgs::PredictPlansGoalConstPtr& goal);
  void finishCancelled();

  PlanPredictor predictor_;
  OwnThread service_thread_, action_thread_;
  ros::ServiceServer service_;
  Action action_;
};

}  // namespace softbody
