#include "nodes/prediction/prediction_messages.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "nodes/simulator/reaction_publisher.h"
#include "softbody_common/ros/geometry_messages.h"

namespace softbody {
namespace {

constexpr double kShortestStep = 1e-3, kLongestStep = 1.0, kLongestTime = 60.0;  // [s]
constexpr std::size_t kMostStates = 100000;                                      // of one answer
constexpr double kMostSteps = 100000;  // of all plans: some minutes of computing

void requireAscending(const std::vector<double>& times, const std::string& what) {
  double before = 0.0;
  for (const double time : times) {
    if (!(time > before && time <= kLongestTime)) {
      throw std::invalid_argument(
          fmt::format("{}: {} s comes after {} s; allowed: ascending times above 0, up to {} s", what, time,
                      before, kLongestTime));
    }
    before = time;
  }
}

RigidPath pathOf(const softbody_msgs::PlannedMotion& message) {
  const std::string what = fmt::format("motion of '{}'", message.name.substr(0, 100));
  requireAscending(message.times, what);
  if (message.times.size() != message.poses.size()) {
    throw std::invalid_argument(
        fmt::format("{}: {} times with {} poses", what, message.times.size(), message.poses.size()));
  }
  RigidPath path;
  path.times_s = message.times;
  for (const geometry_msgs::Pose& pose : message.poses) path.motions.push_back(fromMessage(pose));
  return path;
}

/// Per entry the path of its name, or one without motion.
std::vector<RigidPath> pathsOf(const std::vector<std::string>& names,
                               const std::map<std::string, RigidPath>& paths) {
  std::vector<RigidPath> result(names.size());
  for (std::size_t k = 0; k < names.size(); ++k) {
    const auto found = paths.find(names[k]);
    if (found != paths.end()) result[k] = found->second;
  }
  return result;
}

bool has(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

void addWrenches(const std::vector<std::string>& names, const std::vector<Wrench>& wrenches,
                 const std::vector<Eigen::Vector3d>& places, std::map<std::string, Wrench>* sums) {
  for (std::size_t k = 0; k < names.size(); ++k) {
    const Wrench wrench = aboutOrigin(wrenches[k], places[k]);
    (*sums)[names[k]].force += wrench.force;
    (*sums)[names[k]].torque += wrench.torque;
  }
}

}  // namespace

void requireUsable(const softbody_msgs::PredictRequest& request) {
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
  if (static_cast<double>(request.plans.size()) * steps > kMostSteps) {
    throw std::invalid_argument(fmt::format(
        "{} plans of {} s in steps of {} s are more than {} steps: ask for fewer plans, a shorter "
        "time or longer steps",
        request.plans.size(), request.times.back(), step, kMostSteps));
  }
}

double timeStepOf(const softbody_msgs::PredictRequest& request) {
  return request.time_step > 0.0 ? request.time_step : 1.0 / 30.0;
}

MotionPlan fromMessage(const softbody_msgs::MotionPlan& message, const NamedSurroundings& present) {
  std::map<std::string, RigidPath> paths;
  for (const softbody_msgs::PlannedMotion& motion : message.motions) {
    if (!has(present.pins, motion.name) && !has(present.obstacles, motion.name)) {
      throw std::invalid_argument(fmt::format(
          "no pin or obstacle that acts has the name '{}': set it by the services pin or set_obstacle first",
          motion.name.substr(0, 100)));
    }
    if (!paths.emplace(motion.name, pathOf(motion)).second)
      throw std::invalid_argument(fmt::format("two motions of '{}' in one plan", motion.name));
  }
  return {present.all, pathsOf(present.pins, paths), pathsOf(present.obstacles, paths)};
}

softbody_msgs::PredictedState toMessage(const PredictedState& state, const NamedSurroundings& present) {
  softbody_msgs::PredictedState message;
  message.time = state.time_s;
  message.converged = static_cast<unsigned char>(state.converged);
  message.vertices = toPoint32s(state.vertices);
  std::vector<Eigen::Vector3d> pins, obstacles;
  for (const Pin& pin : state.surroundings.pins) pins.push_back(pin.position);
  for (const Obstacle& obstacle : state.surroundings.obstacles)
    obstacles.push_back(obstacle.pose.translation());
  std::map<std::string, Wrench> sums;
  addWrenches(present.pins, state.reactions.pins, pins, &sums);
  addWrenches(present.obstacles, state.reactions.obstacles, obstacles, &sums);
  for (const auto& [name, wrench] : sums) {
    message.names.push_back(name);
    geometry_msgs::Wrench& reaction = message.reactions.emplace_back();
    reaction.force = vectorMessage(wrench.force);
    reaction.torque = vectorMessage(wrench.torque);
  }
  return message;
}

}  // namespace softbody
