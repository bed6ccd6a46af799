#include "nodes/prediction/prediction_service.h"

#include <algorithm>
#include <chrono>
#include <future>
#include <stdexcept>
#include <thread>
#include <utility>

#include "nodes/prediction/prediction_messages.h"

namespace softbody {
namespace {

/// One processor stays free for the graph.
int spareProcessors() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency()) - 1); }

}  // namespace

PredictionService::PredictionService(const ros::NodeHandle& node, ros::NodeHandle private_node,
                                     std::function<Present()> present)
    : present_(std::move(present)),
      threads_(spareProcessors()),
      node_calls_(node.getCallbackQueue()),
      spinner_(1, &queue_) {
  private_node.setCallbackQueue(&queue_);
  service_ = private_node.advertiseService("predict", &PredictionService::onPredict, this);
  spinner_.start();
}

PredictionService::~PredictionService() {
  ends_ = true;
  service_.shutdown();
  spinner_.stop();
}

bool PredictionService::onPredict(softbody_msgs::Predict::Request& request,
                                  softbody_msgs::Predict::Response& response) try {
  requireUsable(request);
  const Present present = waitForPresent();
  std::vector<MotionPlan> plans;
  for (const softbody_msgs::MotionPlan& plan : request.plans)
    plans.push_back(fromMessage(plan, present.surroundings));
  const auto predicted = predict(*present.simulator, plans, request.times, timeStepOf(request), threads_);
  for (const std::vector<PredictedState>& states : predicted) {
    for (const PredictedState& state : states)
      response.states.push_back(toMessage(state, present.surroundings));
  }
  response.header = present.header;
  response.revision = present.simulator->topology().revision;
  response.success = 1;
  return true;
} catch (const std::exception& error) {
  response.states.clear();
  response.message = error.what();
  return true;
}

/// The node is between two steps when it answers.
Present PredictionService::waitForPresent() {
  const auto promise = std::make_shared<std::promise<Present>>();
  std::future<Present> answer = promise->get_future();
  node_calls_.add([this, promise] {
    try {
      promise->set_value(present_());
    } catch (...) {
      promise->set_exception(std::current_exception());
    }
  });
  while (answer.wait_for(std::chrono::milliseconds(100)) != std::future_status::ready) {
    if (ends_) throw std::runtime_error("the simulator ends");
  }
  return answer.get();
}

}  // namespace softbody
