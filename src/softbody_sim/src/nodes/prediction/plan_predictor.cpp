#include "nodes/prediction/plan_predictor.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <thread>
#include <utility>

#include "nodes/give_way.h"
#include "nodes/prediction/plan_messages.h"
#include "nodes/prediction/prediction_messages.h"
#include "softbody_sim/prediction/prediction.h"

namespace softbody {
namespace {

// Some seconds to minutes of computing. Nobody can end a call of the service.
constexpr double kMostSteps = 1e5, kMostStepsWithCancel = 1e6;

/// One processor stays free for the graph.
int spareProcessors() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency()) - 1); }

std::vector<MotionPlan> plansOf(const softbody_msgs::PredictRequest& request, const Present& present) {
  std::vector<MotionPlan> plans;
  for (const softbody_msgs::MotionPlan& message : request.plans) {
    try {
      plans.push_back(fromMessage(message, present, timeStepOf(request)));
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(fmt::format("plan {}: {}", plans.size(), error.what()));
    }
  }
  return plans;
}

}  // namespace

PlanPredictor::PlanPredictor(const ros::NodeHandle& node, FindPresent find_present)
    : find_present_(std::move(find_present)), threads_(spareProcessors()), node_calls_(node) {}

std::optional<softbody_msgs::PredictResponse> PlanPredictor::answer(
    const softbody_msgs::PredictRequest& request, const std::function<bool()>& is_cancelled,
    const std::function<void(std::size_t)>& on_progress) try {
  requireUsable(request, is_cancelled ? kMostStepsWithCancel : kMostSteps);
  const std::function<bool()> ends = [&] { return ends_ || (is_cancelled && is_cancelled()); };
  const std::optional<Present> present = waitForPresent(framesOf(request.plans), ends);
  if (!present) return std::nullopt;
  requireAnswerFits(request, present->simulator->topology().rest_vertices.rows());
  PredictionSettings settings;
  settings.times_s = request.times;
  settings.time_step_s = timeStepOf(request);
  settings.threads = threads_;
  settings.is_cancelled = ends;
  settings.on_progress = on_progress;
  settings.on_thread_start = giveWay;
  const auto predicted = predict(*present->simulator, plansOf(request, *present), settings);
  if (predicted.empty()) return std::nullopt;
  softbody_msgs::PredictResponse response;
  for (const std::vector<PredictedState>& states : predicted) {
    for (const PredictedState& state : states) response.states.push_back(toMessage(state));
  }
  response.header = present->header;
  response.revision = present->simulator->topology().revision;
  response.success = 1;
  return response;
} catch (const std::exception& error) {
  softbody_msgs::PredictResponse response;
  response.message = error.what();
  return response;
}

/// The node is between two steps when it answers.
std::optional<Present> PlanPredictor::waitForPresent(const std::set<std::string>& frames,
                                                     const std::function<bool()>& ends) {
  requireFewFrames(frames);
  if (ends()) return std::nullopt;
  return node_calls_.result<Present>([this, frames] { return find_present_(frames); }, ends);
}

}  // namespace softbody
