#include "nodes/prediction/prediction_messages.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "nodes/prediction/plan_messages.h"
#include "softbody_common/ros/geometry_messages.h"

namespace softbody {
namespace {

constexpr double kShortestStep = 1e-3, kLongestStep = 1.0;  // [s]
constexpr std::size_t kMostStates = 100000;                 // of one answer
constexpr double kMostVertices = 2e7;                       // likewise: 240 MB
constexpr std::size_t kMostFrames = 100;                    // of tf: a robot has some tens

}  // namespace

void requireUsable(const softbody_msgs::PredictRequest& request, double most_steps) {
  if (request.time_step != 0.0 &&
      !(request.time_step >= kShortestStep && request.time_step <= kLongestStep)) {
    throw std::invalid_argument(fmt::format("time_step is {} s; allowed: 0 (1/30 s), or {} to {} s",
                                            request.time_step, kShortestStep, kLongestStep));
  }
  requireAscending(request.times, "times");
  if (request.times.empty() || request.plans.empty())
    throw std::invalid_argument("nothing to predict: give at least one time and one plan");
  if (request.times.size() * request.plans.size() > kMostStates) {
    throw std::invalid_argument(fmt::format("{} plans at {} times; allowed: up to {} states",
                                            request.plans.size(), request.times.size(), kMostStates));
  }
  const double step = timeStepOf(request), steps = std::ceil(request.times.back() / step);
  if (static_cast<double>(request.plans.size()) * steps > most_steps) {
    throw std::invalid_argument(fmt::format(
        "{} plans of {} s in steps of {:.4g} s are more than {:.0f} steps: ask for fewer plans, a "
        "shorter time or longer steps",
        request.plans.size(), request.times.back(), step, most_steps));
  }
}

void requireFewFrames(const std::set<std::string>& frames) {
  if (frames.size() <= kMostFrames) return;
  throw std::invalid_argument(
      fmt::format("the plans name {} frames of tf; allowed: up to {}: give the poses in fewer frames",
                  frames.size(), kMostFrames));
}

void requireAnswerFits(const softbody_msgs::PredictRequest& request, Eigen::Index vertex_count) {
  const auto plans = request.plans.size(), times = request.times.size();
  if (static_cast<double>(plans * times) * static_cast<double>(vertex_count) <= kMostVertices) return;
  throw std::invalid_argument(fmt::format(
      "{} plans at {} times with {} vertices are more than {:.0f} vertices: ask for fewer plans or "
      "fewer times",
      plans, times, vertex_count, kMostVertices));
}

double timeStepOf(const softbody_msgs::PredictRequest& request) {
  return request.time_step > 0.0 ? request.time_step : 1.0 / 30.0;
}

softbody_msgs::PredictedState toMessage(const PredictedState& state) {
  softbody_msgs::PredictedState message;
  message.time = state.time_s;
  message.converged = static_cast<unsigned char>(state.converged);
  message.vertices = toPoint32s(state.vertices);
  for (const auto& [name, wrench] : state.reactions) {
    message.names.push_back(name);
    geometry_msgs::Wrench& reaction = message.reactions.emplace_back();
    reaction.force = vectorMessage(wrench.force);
    reaction.torque = vectorMessage(wrench.torque);
  }
  for (std::size_t k = 0; k < state.contacts.size(); ++k) {
    softbody_msgs::ContactPatch& contact = message.contacts.emplace_back();
    contact.name = state.contact_names[k];
    contact.place = pointMessage(state.contacts[k].place);
    contact.normal = vectorMessage(state.contacts[k].normal);
    contact.force = vectorMessage(state.contacts[k].force);
    contact.torque = vectorMessage(state.contacts[k].torque);
  }
  return message;
}

}  // namespace softbody
