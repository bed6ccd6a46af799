#include <benchmark/benchmark.h>
#include <time.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "bench/bent_bodies.h"
#include "softbody_common/tet_geometry.h"
#include "softbody_common/tet_locator.h"
#include "softbody_sim/dynamics/simulator.h"

/// Times frames of the simulator with the tracker's kind of input. The body bends to and fro under 1500 depth
/// targets with normals on its upper side. Their places change in every frame, so the matrix changes, too.
/// Measures processor time of one thread, with the default parameters; `iterations` always runs all 20
/// iterations.
namespace {

using namespace softbody;
using namespace softbody::bench;

constexpr int kTargets = 1500, kFrames = 60, kRuns = 5;
constexpr Nanoseconds kFrame = 33333333;
constexpr double kDepthNoise_m = 5e-4;

/// Corners of a surface triangle, one per row.
Eigen::Matrix3d cornersOf(const TetTopology& body, const Points& x, Eigen::Index f) {
  Eigen::Matrix3d corners;
  for (int k = 0; k < 3; ++k) corners.row(k) = x.row(body.surface(f, k));
  return corners;
}

/// Outward normal with twice the area as length [m^2].
Eigen::Vector3d areaVector(const Eigen::Matrix3d& corners) {
  const Eigen::Vector3d a = corners.row(1) - corners.row(0), b = corners.row(2) - corners.row(0);
  return a.cross(b);
}

/// Targets at random points of the upward-facing surface, for vertices x [m].
std::vector<Target> depthTargets(const TetTopology& body, const TetLocator& locator, const Points& x,
                                 std::mt19937* random) {
  std::vector<double> areas;
  double visible = 0.0;
  for (Eigen::Index f = 0; f < body.surface.rows(); ++f) {
    const Eigen::Vector3d area = areaVector(cornersOf(body, x, f));
    areas.push_back(area.z() > 0.3 * area.norm() ? 0.5 * area.norm() : 0.0);
    visible += areas.back();
  }
  std::discrete_distribution<Eigen::Index> triangle(areas.begin(), areas.end());
  std::exponential_distribution<double> share;
  std::normal_distribution<double> noise(0.0, kDepthNoise_m);
  const double edge = meanEdgeLength(body.rest_vertices, body.tets);
  std::vector<Target> targets(kTargets);
  for (Target& target : targets) {
    const Eigen::Index f = triangle(*random);
    Eigen::RowVector3d shares(share(*random), share(*random), share(*random));
    shares /= shares.sum();
    target.place = locator.locate((shares * cornersOf(body, body.rest_vertices, f)).transpose());
    target.normal = areaVector(cornersOf(body, x, f)).normalized();
    target.position = (shares * cornersOf(body, x, f)).transpose() + noise(*random) * target.normal;
    target.weight = visible / (kTargets * edge * edge);  // proportional to area, like depth targets
  }
  return targets;
}

std::vector<TargetSet> bending(const TetTopology& body) {
  const TetLocator locator(body.rest_vertices, body.tets);
  std::mt19937 random(4);
  std::vector<TargetSet> frames(kFrames);
  for (int frame = 0; frame < kFrames; ++frame) {
    const double curvature = 1e-6 + 7.0 * std::sin(2.0 * M_PI * frame / kFrames);
    frames[frame].targets = depthTargets(body, locator, bent(body.rest_vertices, curvature), &random);
  }
  frames[0].reset = true;
  return frames;
}

/// Processor time of this thread [ms].
double processorTime_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

struct Times {
  double mean_ms = 0.0, longest_ms = 0.0;  ///< of a frame, minimum over several runs
  double iterations = 0.0;                 ///< mean
};

/// Leaves out the first two frames, which allocate.
Times timesOf(const std::string& name, const SimulatorConfig& config) {
  const TetTopology body = bodyTopology(name);
  const std::vector<TargetSet> frames = bending(body);
  Simulator simulator(body, Material(), config);
  std::vector<double> least(kFrames, std::numeric_limits<double>::max());
  Times times;
  constexpr int kFirst = 2;
  for (int run = 0; run < kRuns; ++run) {
    for (int frame = 0; frame < kFrames; ++frame) {
      const double begin = processorTime_ms();
      simulator.step(frames[frame], frame * kFrame);
      least[frame] = std::min(least[frame], processorTime_ms() - begin);
      if (frame >= kFirst) times.iterations += simulator.report().iterations;
    }
  }
  for (int frame = kFirst; frame < kFrames; ++frame) {
    times.mean_ms += least[frame] / (kFrames - kFirst);
    times.longest_ms = std::max(times.longest_ms, least[frame]);
  }
  times.iterations /= kRuns * (kFrames - kFirst);
  return times;
}

void frame(benchmark::State& state, const std::string& name) {
  for (auto _ : state) {
    const Times times = timesOf(name, {});
    state.counters["simulator.step [ms]"] = times.mean_ms;
    state.counters["longest [ms]"] = times.longest_ms;
    state.counters["iterations"] = times.iterations;
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
