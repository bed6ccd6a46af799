#include <benchmark/benchmark.h>
#include <time.h>

#include <algorithm>
#include <string>
#include <vector>

#include "bench/bent_bodies.h"
#include "fixtures/random_plans.h"

/// Predictions of a second, in 30 steps, with one thread: how many a second of processor time, and how many
/// of 540 random plans converge, for each body.
namespace {

using namespace softbody;
using namespace softbody::bench;

enum class Kind { kLift, kPush, kGrip };

double processorTime_s() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::vector<MotionPlan> plansOf(Kind kind, int count, testing::PredictionScene* scene) {
  std::vector<MotionPlan> plans;
  for (int k = 0; k < count; ++k) {
    plans.push_back(kind == Kind::kLift   ? scene->plans.lift(scene->hand)
                    : kind == Kind::kPush ? scene->plans.push()
                                          : scene->plans.grip());
  }
  return plans;
}

/// Of all plans that converge to the end.
int convergedOf(const std::vector<std::vector<PredictedState>>& results) {
  return static_cast<int>(std::count_if(results.begin(), results.end(),
                                        [](const auto& states) { return states.back().converged; }));
}

void speed(benchmark::State& state, const std::string& name, const std::string& plan, Kind kind) {
  constexpr int kPlans = 100;
  testing::PredictionScene scene(bodyTopology(name), Material(), 1);
  const std::vector<MotionPlan> plans = plansOf(kind, kPlans, &scene);
  const Simulator& present = kind == Kind::kLift ? scene.held : scene.lying;
  for (auto _ : state) {
    const double begin = processorTime_s();
    const auto results = predict(present, plans, {{1.0}});
    const double per_second = kPlans / (processorTime_s() - begin);
    state.counters["predictions_per_s"] = per_second;
    state.counters["converged"] = convergedOf(results);
    state.counters["summary/predictions_per_s/" + name + "_" + plan] = per_second;
  }
}

/// Bodies of 5 to 500 kPa.
void convergence(benchmark::State& state, const std::string& name) {
  constexpr int kScenes = 20, kPlansPerKind = 9;
  const TetTopology body = bodyTopology(name);
  for (auto _ : state) {
    int converged = 0, all = 0;
    for (unsigned seed = 0; seed < kScenes; ++seed) {
      Material material;
      material.youngs_modulus_pa = testing::RandomPlans(body.rest_vertices, seed).logUniform(5e3, 5e5);
      testing::PredictionScene scene(body, material, seed);
      for (const Kind kind : {Kind::kLift, Kind::kPush, Kind::kGrip}) {
        const auto plans = plansOf(kind, kPlansPerKind, &scene);
        const int count =
            convergedOf(predict(kind == Kind::kLift ? scene.held : scene.lying, plans, {{1.0}}));
        converged += count;
        all += kPlansPerKind;
      }
    }
    state.counters["converged_percent"] = 100.0 * converged / all;
    state.counters["summary/predictions_converged_percent/" + name] = 100.0 * converged / all;
  }
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  for (const std::string name : {"sponge", "doll"}) {
    const std::pair<std::string, Kind> kinds[] = {
        {"lift", Kind::kLift}, {"push", Kind::kPush}, {"grip", Kind::kGrip}};
    for (const auto& [plan, kind] : kinds) {
      const auto run = [name, plan = plan, kind = kind](benchmark::State& s) { speed(s, name, plan, kind); };
      benchmark::RegisterBenchmark((plan + "/" + name).c_str(), run)->Iterations(1);
    }
    benchmark::RegisterBenchmark(("convergence/" + name).c_str(), [name](benchmark::State& s) {
      convergence(s, name);
    })->Iterations(1);
  }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
