#pragma once

#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <softbody_msgs/Predict.h>

#include <atomic>
#include <functional>
#include <memory>

#include "nodes/prediction/named_surroundings.h"
#include "softbody_common/ros/queued_calls.h"
#include "softbody_sim/dynamics/simulator.h"

namespace softbody {

/// The present, to predict from.
struct Present {
  std::unique_ptr<Simulator> simulator;
  NamedSurroundings surroundings;
  std_msgs::Header header;
};

/// The service ~predict. It answers in a thread of its own; the node only copies its simulator.
class PredictionService {
 public:
  /// @param present is called in the node's queue. @throw std::invalid_argument if the body is not placed.
  PredictionService(const ros::NodeHandle& node, ros::NodeHandle private_node,
                    std::function<Present()> present);
  ~PredictionService();

 private:
  bool onPredict(softbody_msgs::Predict::Request& request, softbody_msgs::Predict::Response& response);
  Present waitForPresent();

  std::function<Present()> present_;
  const int threads_;
  std::atomic<bool> ends_{false};
  QueuedCalls node_calls_;
  ros::CallbackQueue queue_;
  ros::AsyncSpinner spinner_;
  ros::ServiceServer service_;
};

}  // namespace softbody
