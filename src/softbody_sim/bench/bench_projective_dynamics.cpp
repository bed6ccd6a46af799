#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <map>
#include <memory>

#include "bench/bent_bodies.h"
#include "bench/plain_projective_dynamics.h"
#include "linear_solvers/global_step_solver.h"
#include "softbody_sim/dynamics/simulator.h"
#include "tets/tet_matrix.h"
#include "time_step/fem_solver.h"
#include "time_step/projective_dynamics.h"

/// Compares projective dynamics with a plain implementation, on bent bodies with one thread. `frame`: ten
/// iterations, with and without the volume term. `converged`: iterations until every vertex is within 1e-6
/// mean edge lengths of the minimum. `update`: a matrix with a few other targets, against a new one. The
/// prefix `smoothed/` means the simulator's default strain smoothing, compared with a plain solver of the
/// same energy. `volume_smoothing`: the time with all of the volume energy smoothed, relative to that of a
/// sponge.
namespace {

using namespace softbody;
using namespace softbody::bench;
using benchmark::State;

constexpr int kFrameIterations = 10;

/// No strain smoothing, or that of SimulatorConfig.
enum class Strains { kOfTets, kSmoothed };

double smoothingOf(Strains strains) {
  return strains == Strains::kSmoothed ? SimulatorConfig().strain_smoothing : 0.0;
}

/// Prefix of rows and summary keys with smoothing.
std::string prefixOf(Strains strains, const std::string& separator) {
  return strains == Strains::kSmoothed ? "smoothed" + separator : "";
}

const BentBody& bodyOf(const std::string& name, bool with_volume) {
  static std::map<std::pair<std::string, bool>, BentBody> made;
  const auto key = std::make_pair(name, with_volume);
  if (made.count(key) == 0) made.emplace(key, bentBody(bodyTopology(name), with_volume ? 0.3 : 0.0));
  return made.at(key);
}

ElasticMaterials materialsOf(const BentBody& body, Strains strains) {
  return {body.lame, smoothingOf(strains)};
}

ProjectiveDynamicsOptions options(bool single, Simd simd, int iterations, int history) {
  ProjectiveDynamicsOptions chosen;
  chosen.minimizer = {iterations, 0.0, history};
  chosen.single_precision = single;
  chosen.simd = simd;
  return chosen;
}

/// Vector instructions of this processor, widest first.
std::vector<Simd> widths() {
  std::vector<Simd> found;
  for (Simd simd : {Simd::kAvx512, Simd::kAvx2, Simd::kSse4}) {
    if (static_cast<int>(simd) <= static_cast<int>(supportedSimd(Simd::kAuto))) found.push_back(simd);
  }
  return found;
}

double usedMemory() {
  const auto info = mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd);
}

using Run = std::function<void()>;

/// Minimum wall time of each run [s]. The runs take turns, so that the machine's load affects all. A turn
/// lasts at least one millisecond, so that each run has its data in the cache.
std::vector<double> leastTimes(const std::vector<Run>& runs) {
  constexpr double kLongest_s = 4.0, kTurn_s = 1e-3;
  constexpr int kFewest = 3, kMost = 200;
  std::vector<double> least(runs.size(), 1e9);
  const auto start = std::chrono::steady_clock::now();
  const auto seconds = [](auto from) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - from).count();
  };
  for (int round = 0; round < kFewest || (round < kMost && seconds(start) < kLongest_s); ++round) {
    for (std::size_t i = 0; i < runs.size(); ++i) {
      const auto turn = std::chrono::steady_clock::now();
      do {
        const auto begin = std::chrono::steady_clock::now();
        runs[i]();
        least[i] = std::min(least[i], seconds(begin));
      } while (seconds(turn) < kTurn_s);
    }
  }
  return least;
}

Run plainFrame(const BentBody& body, Strains strains, int iterations) {
  const auto solver = std::make_shared<PlainProjectiveDynamics>(body.topology, body.lame, body.potential,
                                                                smoothingOf(strains));
  return [solver, &body, iterations] {
    Points x = body.start;
    for (int k = 0; k < iterations; ++k) solver->iterate(body.potential, &x);
    benchmark::DoNotOptimize(x.data());
  };
}

Run fastFrame(const BentBody& body, const ElasticMaterials& materials,
              const ProjectiveDynamicsOptions& chosen) {
  const auto solver = std::make_shared<ProjectiveDynamics>(body.topology, materials, chosen);
  Run frame = [solver, &body] {
    Points x = body.start;
    solver->minimize(body.potential, &x);
    benchmark::DoNotOptimize(x.data());
  };
  // As after a few frames: the matrix is factored, and inverted if it is small.
  for (int k = 0; k < (body.start.rows() > GlobalStepSolver<float>::kLargestInverse ? 1 : 30); ++k) frame();
  return frame;
}

/// Minimum number of iterations after which `run(iterations)` is within 1e-6 mean edge lengths of the
/// minimum.
int iterationsToMinimum(const BentBody& body, Strains strains, const std::function<Points(int)>& run) {
  Points minimum = body.start;
  ProjectiveDynamics(body.topology, materialsOf(body, strains), options(false, Simd::kAuto, 2000, 5))
      .minimize(body.potential, &minimum);
  for (int iterations = 1; iterations < 1000; ++iterations) {
    const double distance = (run(iterations) - minimum).rowwise().norm().maxCoeff();
    if (distance < 1e-6 * body.edge_length) return iterations;
  }
  return 1000;
}

/// One column per solver: time [us], and speed relative to the plain solver.
void report(State& state, const std::vector<std::string>& names, const std::vector<double>& times) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    state.counters[names[i] + " us"] = 1e6 * times[i];
    if (i > 0) state.counters[names[i] + " ratio"] = times[0] / times[i];
  }
}

void frames(State& state, const std::string& name, bool with_volume, Strains strains) {
  const BentBody& body = bodyOf(name, with_volume);
  std::vector<std::string> names{"plain"};
  std::vector<Run> runs{plainFrame(body, strains, kFrameIterations)};
  const double before = usedMemory();
  double bytes = 0.0;
  for (bool single : {true, false}) {
    for (Simd simd : widths()) {
      names.push_back(fmt::format("{} {}", single ? "float" : "double", nameOf(simd)));
      runs.push_back(fastFrame(body, materialsOf(body, strains), options(single, simd, kFrameIterations, 0)));
      if (bytes == 0.0) bytes = usedMemory() - before;
    }
  }
  const auto tets = static_cast<double>(body.topology.tets.rows());
  for (auto _ : state) {
    const std::vector<double> times = leastTimes(runs);
    report(state, names, times);
    state.counters["tets"] = tets;
    if (!with_volume) continue;
    const std::string prefix = prefixOf(strains, "_");
    state.counters[fmt::format("summary/pd_{}frame_ratio/{}", prefix, name)] = times[0] / times[1];
    state.counters[fmt::format("summary/pd_{}bytes_per_tet/{}", prefix, name)] = bytes / tets;
    state.counters[fmt::format("summary/pd_{}frame_ns_per_tet/{}", prefix, name)] = 1e9 * times[1] / tets;
  }
}

void converged(State& state, Strains strains) {
  const BentBody& body = bodyOf("sponge", true);
  const int plain_iterations = iterationsToMinimum(body, strains, [&](int count) {
    Points x = body.start;
    PlainProjectiveDynamics solver(body.topology, body.lame, body.potential, smoothingOf(strains));
    for (int k = 0; k < count; ++k) solver.iterate(body.potential, &x);
    return x;
  });
  state.counters["plain iterations"] = plain_iterations;
  std::vector<std::string> names{"plain"};
  std::vector<Run> runs{plainFrame(body, strains, plain_iterations)};
  for (int history : {5, 0}) {
    const int iterations = iterationsToMinimum(body, strains, [&](int count) {
      Points x = body.start;
      const auto chosen = options(false, Simd::kAuto, count, history);
      ProjectiveDynamics(body.topology, materialsOf(body, strains), chosen).minimize(body.potential, &x);
      return x;
    });
    const std::string kind = history > 0 ? "double lbfgs " : "double ";
    state.counters[kind + "iterations"] = iterations;
    for (Simd simd : widths()) {
      names.push_back(kind + nameOf(simd));
      runs.push_back(fastFrame(body, materialsOf(body, strains), options(false, simd, iterations, history)));
    }
  }
  for (auto _ : state) {
    const std::vector<double> times = leastTimes(runs);
    report(state, names, times);
    state.counters[fmt::format("summary/pd_{}converged_ratio/sponge", prefixOf(strains, "_"))] =
        times[0] / times[1];
  }
}

/// What it costs to smooth all of the volume energy, as nearly incompressible bodies need, instead of the
/// share of a sponge: a step of the node, and one iteration of finite elements.
void volumeSmoothingCost(State& state, const std::string& name) {
  const BentBody& body = bodyOf(name, true);
  const SimulatorConfig node;
  std::vector<Run> runs;
  for (const double volume : {volumeSmoothing(0.2), 1.0}) {
    const ElasticMaterials materials(body.lame, {node.strain_smoothing, volume});
    runs.push_back(
        fastFrame(body, materials, options(false, Simd::kAuto, node.iterations, node.lbfgs_history)));
    const auto fem = std::make_shared<FemSolver>(body.topology, Elasticity::kCorotated, materials,
                                                 FemSolver::Options{1, 0.0});
    runs.push_back([fem, &body] {
      Points x = body.start;
      fem->minimize(body.potential, &x);
    });
  }
  for (auto _ : state) {
    const std::vector<double> times = leastTimes(runs);
    for (std::size_t k = 0; k < 2; ++k) {
      const std::string solver = k == 0 ? "pd" : "fem";
      state.counters[solver + " us"] = 1e6 * times[k];
      state.counters[solver + " all smoothed us"] = 1e6 * times[k + 2];
      state.counters[fmt::format("summary/{}_volume_smoothing_cost/{}", solver, name)] =
          times[k + 2] / times[k];
    }
  }
}

/// Times updates of the factor for a number of changed targets. Also reports the largest number for which an
/// update is faster than a new factorisation.
void updates(State& state, const std::string& name) {
  const BentBody& body = bodyOf(name, true);
  const TetMatrix metric = bench::metricOf(body);
  GlobalStepSolver<float> solver(metric.lower(), Simd::kAuto);
  std::vector<Run> runs{[&] { solver.factorize(metric.lower()); }};
  const std::vector<int> counts{1, 2, 4, 8, 16, 32, 64};
  for (int count : counts) {
    std::vector<TetVector> changes;
    for (int k = 0; k < count; ++k) {
      const auto& spring = body.potential.targets.springs()[static_cast<std::size_t>(k)];
      changes.push_back({spring.vertices, std::sqrt(spring.stiffness) * spring.barycentric});
    }
    runs.push_back([&solver, changes] {
      solver.update(changes, {});
      solver.update({}, changes);
    });
  }
  for (auto _ : state) {
    const std::vector<double> times = leastTimes(runs);
    state.counters["factor us"] = 1e6 * times[0];
    double crossover = 0.0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
      const double update = 0.5 * times[i + 1];
      state.counters[fmt::format("update {} us", counts[i])] = 1e6 * update;
      if (update < times[0]) crossover = counts[i];
    }
    state.counters["summary/pd_largest_cheaper_update/" + name] = crossover;
  }
}

template <typename Measure>
auto* add(const std::string& name, Measure measure) {
  return benchmark::RegisterBenchmark(name.c_str(), measure)->Unit(benchmark::kMicrosecond);
}

void addBody(const std::string& name) {
  for (bool with_volume : {true, false}) {
    add(fmt::format("frame/{}/{}", name, with_volume ? "volume" : "no_volume"), [=](State& s) {
      frames(s, name, with_volume, Strains::kOfTets);
    })->Iterations(1);
  }
  add(fmt::format("smoothed/frame/{}/volume", name), [=](State& s) {
    frames(s, name, true, Strains::kSmoothed);
  })->Iterations(1);
  add("update/" + name, [name](State& s) { updates(s, name); })->Iterations(1);
  add("volume_smoothing/" + name, [name](State& s) { volumeSmoothingCost(s, name); })->Iterations(1);
}

void vectorWidth(State& state) {
  const std::map<Simd, int> bits{{Simd::kSse4, 128}, {Simd::kAvx2, 256}, {Simd::kAvx512, 512}};
  for (auto _ : state) state.counters["summary/vector_width_bits"] = bits.at(supportedSimd(Simd::kAuto));
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  add("vector_width", vectorWidth)->Iterations(1);
  for (const char* body : {"sponge", "doll", "1k", "10k", "100k"}) addBody(body);
  for (const Strains strains : {Strains::kOfTets, Strains::kSmoothed})
    add(prefixOf(strains, "/") + "converged/sponge", [=](State& s) { converged(s, strains); })->Iterations(1);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
