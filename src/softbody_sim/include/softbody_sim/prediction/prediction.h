#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "softbody_sim/constraints/contact_patch.h"
#include "softbody_sim/dynamics/simulator.h"
#include "softbody_sim/prediction/motion_plan.h"

namespace softbody {

struct PredictedState {
  double time_s = 0.0;    ///< from the present state
  bool converged = true;  ///< all steps up to this time
  Points vertices;        ///< [m]
  /// On the pins and obstacles that act, by name: the body's force, and its torque about the frame's origin.
  std::map<std::string, Wrench> reactions;
  std::vector<ContactPatch> contacts;      ///< on the plan's obstacles
  std::vector<std::string> contact_names;  ///< per patch: of the obstacle
};

struct PredictionSettings {
  std::vector<double> times_s;  ///< ascending; a state is that after the first step that reaches its time
  double time_step_s = 1.0 / 30.0;
  int threads = 1;
  /// Called from the threads after each step; true: predict() ends. Empty: never.
  std::function<bool()> is_cancelled = {};
  /// Called by one thread at a time with the number of plans that are done.
  std::function<void(std::size_t)> on_progress = {};
  /// Called once by each thread that predict() starts.
  std::function<void()> on_thread_start = {};
};

/// Simulates each plan from the present state of a placed body, which does not change. The threads share
/// nothing that a plan changes. So a result depends neither on the other plans nor on the number of threads.
/// @return per plan, per time; empty if cancelled. Loads that were estimated go on.
/// @throw std::invalid_argument if a region holds no vertex when it takes hold, or as Simulator::step does;
/// the sentence begins with the plan.
std::vector<std::vector<PredictedState>> predict(const Simulator& present,
                                                 const std::vector<MotionPlan>& plans,
                                                 const PredictionSettings& settings);

}  // namespace softbody
