#pragma once

#include <ros/ros.h>
#include <softbody_msgs/Predict.h>

#include <atomic>
#include <functional>
#include <optional>
#include <set>
#include <string>

#include "nodes/node_calls.h"
#include "nodes/prediction/present.h"

namespace softbody {

/// Answers requests for predictions, from any thread. The node only copies its simulator.
class PlanPredictor {
 public:
  /// @param frames names of tf frames, whose poses are wanted. @throw std::invalid_argument if the body is
  /// not placed.
  using FindPresent = std::function<Present(const std::set<std::string>& frames)>;

  /// @param find_present is called in the node's queue.
  PlanPredictor(const ros::NodeHandle& node, FindPresent find_present);

  /// @param is_cancelled, on_progress as in PredictionSettings; may be empty. Who can cancel may ask for
  /// more. @return empty: it was cancelled, or end() was called.
  std::optional<softbody_msgs::PredictResponse> answer(
      const softbody_msgs::PredictRequest& request, const std::function<bool()>& is_cancelled = {},
      const std::function<void(std::size_t)>& on_progress = {});

  /// Ends all answers soon.
  void end() { ends_ = true; }

 private:
  std::optional<Present> waitForPresent(const std::set<std::string>& frames,
                                        const std::function<bool()>& ends);

  FindPresent find_present_;
  const int threads_;
  std::atomic<bool> ends_{false};
  NodeCalls node_calls_;
};

}  // namespace softbody
