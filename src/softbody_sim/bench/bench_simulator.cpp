#include <benchmark/benchmark.h>
#include <time.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "bench/bending_targets.h"
#include "bench/bent_bodies.h"
#include "softbody_sim/dynamics/simulator.h"

/// Times frames of the simulator with the tracker's kind of input. The body bends to and fro under 1500 depth
/// targets with normals on its upper side. Their places change in every frame, so the matrix changes, too.
/// Measures processor time of one thread, with the default parameters; `iterations` always runs all 20
/// iterations.
namespace {

using namespace softbody;
using namespace softbody::bench;

constexpr int kFrames = 60, kRuns = 5;
constexpr Nanoseconds kFrame = 33333333;

/// Processor time of this thread [ms].
double processorTime_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

struct Times {
  double mean_ms = 0.0, longest_ms = 0.0;  ///< of a frame, minimum over several runs
  double iterations = 0.0;                 ///< mean
  double unbalanced = 0.0;                 ///< forces that the iterations leave, as a share; mean
};

/// Leaves out the first two frames, which allocate.
Times timesOf(const std::string& name, const SimulatorConfig& config) {
  const TetTopology body = bodyTopology(name);
  const std::vector<TargetSet> frames = bendingTargets(body, kFrames);
  Simulator simulator(body, Material(), config);
  std::vector<double> least(kFrames, std::numeric_limits<double>::max());
  Times times;
  constexpr int kFirst = 2;
  for (int run = 0; run < kRuns; ++run) {
    for (int frame = 0; frame < kFrames; ++frame) {
      const double begin = processorTime_ms();
      simulator.step(frames[frame], frame * kFrame);
      least[frame] = std::min(least[frame], processorTime_ms() - begin);
      if (frame < kFirst) continue;
      times.iterations += simulator.report().iterations;
      times.unbalanced += simulator.report().residual_n / simulator.report().external_n;
    }
  }
  for (int frame = kFirst; frame < kFrames; ++frame) {
    times.mean_ms += least[frame] / (kFrames - kFirst);
    times.longest_ms = std::max(times.longest_ms, least[frame]);
  }
  times.iterations /= kRuns * (kFrames - kFirst);
  times.unbalanced /= kRuns * (kFrames - kFirst);
  return times;
}

void frame(benchmark::State& state, const std::string& name) {
  for (auto _ : state) {
    const Times times = timesOf(name, {});
    state.counters["simulator.step [ms]"] = times.mean_ms;
    state.counters["longest [ms]"] = times.longest_ms;
    state.counters["iterations"] = times.iterations;
    state.counters["unbalanced"] = times.unbalanced;
    state.counters["summary/simulator_frame_ms/" + name] = times.mean_ms;
  }
}

void allIterations(benchmark::State& state) {
  SimulatorConfig config;
  config.iterations = 20;
  config.tolerance = 0.0;
  for (auto _ : state) {
    const Times times = timesOf("10k", config);
    state.counters["simulator.step [ms]"] = times.mean_ms;
    state.counters["longest [ms]"] = times.longest_ms;
    state.counters["iterations"] = times.iterations;
    state.counters["unbalanced"] = times.unbalanced;
    state.counters["summary/pd_10k_20_iterations_fps"] = 1e3 / times.mean_ms;
  }
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  for (const std::string name : {"sponge", "10k"}) {
    benchmark::RegisterBenchmark(("frame/" + name).c_str(), [name](benchmark::State& s) { frame(s, name); })
        ->Unit(benchmark::kMillisecond)
        ->Iterations(1);
  }
  benchmark::RegisterBenchmark("iterations/10k", allIterations)->Unit(benchmark::kMillisecond)->Iterations(1);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
