#include "softbody_sim/dynamics/prediction.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <thread>

#include "softbody_common/time.h"

namespace softbody {
namespace {

Surroundings surroundingsAt(const MotionPlan& plan, double time_s) {
  Surroundings surroundings = plan.start;
  for (std::size_t k = 0; k < plan.pins.size(); ++k)
    surroundings.pins[k].position = plan.pins[k].at(time_s) * plan.start.pins[k].position;
  for (std::size_t k = 0; k < plan.obstacles.size(); ++k)
    surroundings.obstacles[k].pose = plan.obstacles[k].at(time_s) * plan.start.obstacles[k].pose;
  return surroundings;
}

std::vector<PredictedState> predictOne(const Simulator& present, const MotionPlan& plan,
                                       const std::vector<double>& times_s, double time_step_s) {
  constexpr double kRounding = 1e-9;  // [s]
  const std::unique_ptr<Simulator> simulator = present.copyOfPresent();
  const Nanoseconds start = simulator->stamp();
  TargetSet none;
  none.revision = simulator->topology().revision;
  std::vector<PredictedState> states;
  bool converged = true;
  for (int step = 1; states.size() < times_s.size(); ++step) {
    const double time_s = step * time_step_s;
    const Surroundings surroundings = surroundingsAt(plan, time_s);
    simulator->step(none, start + nanoseconds(time_s), surroundings);
    converged = converged && simulator->report().converged;
    while (states.size() < times_s.size() && times_s[states.size()] <= time_s + kRounding)
      states.push_back(
          {time_s, converged, surroundings, simulator->state().vertices, simulator->reactions()});
  }
  return states;
}

}  // namespace

Eigen::Isometry3d RigidPath::at(double time_s) const {
  const auto after = std::lower_bound(times_s.begin(), times_s.end(), time_s);
  if (times_s.empty()) return Eigen::Isometry3d::Identity();
  if (after == times_s.end()) return motions.back();
  const auto k = static_cast<std::size_t>(after - times_s.begin());
  const Eigen::Isometry3d from = k == 0 ? Eigen::Isometry3d::Identity() : motions[k - 1];
  const double begin_s = k == 0 ? 0.0 : times_s[k - 1];
  const double share = (time_s - begin_s) / (times_s[k] - begin_s);
  const Eigen::Quaterniond turn(from.linear()), next(motions[k].linear());
  const Eigen::Vector3d shift = (1.0 - share) * from.translation() + share * motions[k].translation();
  return Eigen::Translation3d(shift) * turn.slerp(share, next);
}

std::vector<std::vector<PredictedState>> predict(const Simulator& present,
                                                 const std::vector<MotionPlan>& plans,
                                                 const std::vector<double>& times_s, double time_step_s,
                                                 int threads) {
  std::vector<std::vector<PredictedState>> results(plans.size());
  std::vector<std::exception_ptr> errors(plans.size());
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t k = next++; k < plans.size(); k = next++) {
      try {
        results[k] = predictOne(present, plans[k], times_s, time_step_s);
      } catch (...) {
        errors[k] = std::current_exception();
      }
    }
  };
  std::vector<std::thread> workers;
  for (int k = 1; k < threads && static_cast<std::size_t>(k) < plans.size(); ++k) workers.emplace_back(work);
  work();
  for (std::thread& worker : workers) worker.join();
  for (const std::exception_ptr& error : errors) {
    if (error) std::rethrow_exception(error);
  }
  return results;
}

}  // namespace softbody
