#include "nodes/prediction/prediction_service.h"

#include <optional>
#include <utility>

namespace softbody {
namespace {

softbody_msgs::PredictResponse endOfSimulator() {
  softbody_msgs::PredictResponse response;
  response.message = "the simulator ends";
  return response;
}

}  // namespace

PredictionService::PredictionService(const ros::NodeHandle& node, ros::NodeHandle private_node,
                                     PlanPredictor::FindPresent find_present)
    : predictor_(node, std::move(find_present)),
      service_thread_(private_node),
      action_thread_(private_node),
      service_(
          service_thread_.node
              .advertiseService<softbody_msgs::PredictRequest, softbody_msgs::PredictResponse>(
                  "predict",
                  [this](softbody_msgs::PredictRequest& request, softbody_msgs::PredictResponse& response) {
                    response = predictor_.answer(request).value_or(endOfSimulator());
                    return true;
                  })),
      action_(
          action_thread_.node, "predict_plans", [this](const auto& goal) { onGoal(goal); }, false) {
  action_.start();
  service_thread_.spinner.start();
  action_thread_.spinner.start();
}

PredictionService::~PredictionService() {
  predictor_.end();
  service_.shutdown();
  action_.shutdown();
  service_thread_.spinner.stop();
  action_thread_.spinner.stop();
}

void PredictionService::onGoal(const softbody_msgs::PredictPlansGoalConstPtr& goal) {
  softbody_msgs::PredictRequest request;
  request.time_step = goal->time_step;
  request.times = goal->times;
  request.plans = goal->plans;
  softbody_msgs::PredictPlansFeedback progress;
  progress.total = static_cast<std::uint32_t>(goal->plans.size());
  std::optional<softbody_msgs::PredictResponse> answer = predictor_.answer(
      request, [this] { return action_.isPreemptRequested(); },
      [&](std::size_t done) {
        progress.done = static_cast<std::uint32_t>(done);
        action_.publishFeedback(progress);
      });
  if (!answer && action_.isPreemptRequested()) return finishCancelled();
  softbody_msgs::PredictResponse response = std::move(answer).value_or(endOfSimulator());
  softbody_msgs::PredictPlansResult result;
  result.success = response.success;
  result.message = response.message;
  result.header = response.header;
  result.revision = response.revision;
  result.states = std::move(response.states);
  if (result.success) return action_.setSucceeded(result);
  action_.setAborted(result, result.message);
}

void PredictionService::finishCancelled() {
  softbody_msgs::PredictPlansResult result;
  result.message = action_.isNewGoalAvailable() ? "another goal has come" : "the goal was cancelled";
  action_.setPreempted(result, result.message);
}

}  // namespace softbody
