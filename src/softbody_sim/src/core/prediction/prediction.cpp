#include "softbody_sim/prediction/prediction.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "prediction/planned_surroundings.h"
#include "softbody_common/time/time.h"

namespace softbody {
namespace {

/// The work that the threads of one call share.
class Prediction {
 public:
  Prediction(const Simulator& present, const std::vector<MotionPlan>& plans,
             const PredictionSettings& settings)
      : present_(present), plans_(plans), settings_(settings), results_(plans.size()), end_(plans.size()) {}

  /// Predicts plans until none is left. A plan that fails is the last one. Each thread has one simulator for
  /// all of its plans.
  void work() {
    const std::unique_ptr<Simulator> simulator = present_.copyForPrediction();
    for (std::size_t k = next_++; k < end_ && !cancelled_; k = next_++) {
      try {
        results_[k] = predictOne(plans_[k], simulator.get());
      } catch (...) {
        failAt(k);
      }
      reportProgress();
    }
  }

  /// @throw the error of the first plan that has one.
  std::vector<std::vector<PredictedState>> takeResults() {
    if (cancelled_) return {};
    if (error_) rethrow();
    return std::move(results_);
  }

 private:
  std::vector<PredictedState> predictOne(const MotionPlan& plan, Simulator* simulator);
  void reportProgress();
  void failAt(std::size_t plan);
  [[noreturn]] void rethrow() const;

  const Simulator& present_;
  const std::vector<MotionPlan>& plans_;
  const PredictionSettings& settings_;
  std::vector<std::vector<PredictedState>> results_;
  std::atomic<std::size_t> next_{0}, end_;  ///< a plan that fails is the end
  std::exception_ptr error_;                ///< of plan end_
  std::atomic<bool> cancelled_{false};
  std::mutex lock_;
  std::size_t done_ = 0;
};

PredictedState stateOf(const Simulator& simulator, const PlannedSurroundings& surroundings, double time_s,
                       bool converged) {
  PredictedState state{time_s,
                       converged,
                       simulator.state().vertices,
                       surroundings.sumsOf(simulator.reactions()),
                       simulator.contactPatches(),
                       {}};
  for (ContactPatch& patch : state.contacts) {
    state.contact_names.push_back(surroundings.nameOf(patch.obstacle));
    patch.obstacle = surroundings.planned(patch.obstacle);
  }
  return state;
}

std::vector<PredictedState> Prediction::predictOne(const MotionPlan& plan, Simulator* simulator) {
  simulator->returnTo(present_);
  const Nanoseconds start = simulator->stamp();
  PlannedSurroundings surroundings(plan, simulator->topology(), simulator->state().vertices);
  TargetSet none;
  none.revision = simulator->topology().revision;
  std::vector<PredictedState> states;
  const std::vector<double>& times_s = settings_.times_s;
  bool converged = true;
  for (int step = 1; states.size() < times_s.size(); ++step) {
    if (settings_.is_cancelled && settings_.is_cancelled()) cancelled_ = true;
    if (cancelled_) return {};
    const double time_s = step * settings_.time_step_s;
    simulator->stepUnobserved(
        none, start + nanoseconds(time_s),
        surroundings.during(time_s - settings_.time_step_s, time_s, simulator->state().vertices));
    converged = converged && simulator->report().converged;
    while (states.size() < times_s.size() && times_s[states.size()] <= time_s + kTimeRounding_s)
      states.push_back(stateOf(*simulator, surroundings, time_s, converged));
  }
  return states;
}

void Prediction::reportProgress() {
  if (!settings_.on_progress || cancelled_) return;
  const std::lock_guard<std::mutex> lock(lock_);
  settings_.on_progress(++done_);
}

/// Plans are taken in their order, and those before this one go on. So the first that fails is always found.
void Prediction::failAt(std::size_t plan) {
  const std::lock_guard<std::mutex> lock(lock_);
  if (plan >= end_) return;
  end_ = plan;
  error_ = std::current_exception();
}

void Prediction::rethrow() const {
  try {
    std::rethrow_exception(error_);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(fmt::format("plan {}: {}", end_.load(), error.what()));
  } catch (const std::exception& error) {
    throw std::runtime_error(fmt::format("plan {}: {}", end_.load(), error.what()));
  }
}

}  // namespace

std::vector<std::vector<PredictedState>> predict(const Simulator& present,
                                                 const std::vector<MotionPlan>& plans,
                                                 const PredictionSettings& settings) {
  Prediction prediction(present, plans, settings);
  std::exception_ptr error;
  std::mutex error_lock;
  const auto work = [&] {
    try {
      if (settings.on_thread_start) settings.on_thread_start();
      prediction.work();
    } catch (...) {
      const std::lock_guard<std::mutex> lock(error_lock);
      error = std::current_exception();
    }
  };
  std::vector<std::thread> workers;
  const auto wanted = std::min(static_cast<std::size_t>(std::max(1, settings.threads)), plans.size());
  while (workers.size() < wanted) workers.emplace_back(work);
  for (std::thread& worker : workers) worker.join();
  if (error) std::rethrow_exception(error);
  return prediction.takeResults();
}

}  // namespace softbody
