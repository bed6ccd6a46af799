#include <fmt/format.h>
#include <malloc.h>
#include <time.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/bending_targets.h"
#include "bench/bent_bodies.h"
#include "cutting/fixtures/cut_bodies.h"
#include "softbody_common/statistics/median.h"
#include "softbody_sim/dynamics/simulator.h"
#include "time_step/projective_dynamics.h"

/// Time and memory of one body of a given size, as JSON, for `make growth`. Processor time of one thread.
/// Usage: measure_growth tets CELLS (a cube of CELLS^3 cells of six tets), or measure_growth pieces COUNT
/// (1, 2, 4, 8, 16 or 48 boxes with 10,368 tets together).
namespace {

using namespace softbody;
using namespace softbody::bench;

constexpr int kFrames = 12;
constexpr Nanoseconds kFrame = 33333333;

double processorTime_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

template <typename Work>
double millisecondsOf(const Work& work) {
  const double begin = processorTime_ms();
  work();
  return processorTime_ms() - begin;
}

double usedMemory_mb() {
  const auto info = mallinfo2();
  return 1e-6 * static_cast<double>(info.uordblks + info.hblkhd);
}

TetTopology cube(int cells) {
  return testing::boxTopology(Eigen::Vector3i::Constant(cells), {0.2, 0.1, 0.1});
}

/// Equal boxes of cubic cells in a row along y, with gaps.
TetTopology boxes(int count) {
  Eigen::Vector3i cells(12, 12, 12);
  for (int pieces = 1, axis = 0; pieces < count; axis = (axis + 1) % 3) {
    const int parts = count / pieces % 2 == 0 ? 2 : 3;
    cells[axis] /= parts;
    pieces *= parts;
  }
  if (count * cells.prod() != 1728) throw std::invalid_argument("no such number of pieces");
  constexpr double kCell_m = 0.2 / 12.0;
  const TetTopology box = testing::boxTopology(cells, kCell_m * cells.cast<double>());
  const Eigen::Index vertices = box.rest_vertices.rows(), tets = box.tets.rows();
  TetMesh all{Points(count * vertices, 3), Tets(count * tets, 4)};
  for (int k = 0; k < count; ++k) {
    const Eigen::RowVector3d place(0.0, k * kCell_m * (cells.y() + 1), 0.0);
    all.vertices.middleRows(k * vertices, vertices) = box.rest_vertices.rowwise() + place;
    all.tets.middleRows(k * tets, tets) = box.tets.array() + static_cast<int>(k * vertices);
  }
  return testing::topologyOf(all);
}

/// Ten iterations of projective dynamics with a given factor, as in bench_projective_dynamics.
double solverFrame_ms(const TetTopology& topology) {
  const BentBody body = bentBody(topology, 0.3);
  ProjectiveDynamicsOptions options;
  options.minimizer = {10, 0.0, 0};
  options.single_precision = true;
  ProjectiveDynamics solver(topology, body.lame, options);
  double least = 1e9;
  for (int run = 0; run < kFrames; ++run) {
    Points x = body.start;
    const double frame = millisecondsOf([&] { solver.minimize(body.potential, &x); });
    if (run > 0) least = std::min(least, frame);
  }
  return least;
}

/// A simulator under moving depth targets: preparation with the first frame, median of the others, and a cut
/// through the middle with the next two frames, which make new factors and modes.
std::string measured(const TetTopology& body, double solver_ms) {
  const std::vector<TargetSet> targets = bendingTargets(body, kFrames);
  const double before_mb = usedMemory_mb();
  std::unique_ptr<Simulator> simulator;
  int frame = 0;
  const auto step = [&] {
    simulator->step(targets[static_cast<std::size_t>(frame % kFrames)], frame * kFrame);
    ++frame;
  };
  const double prepare_ms = millisecondsOf([&] {
    simulator = std::make_unique<Simulator>(body, Material(), SimulatorConfig());
    step();
  });
  std::vector<double> frames;
  while (frame < kFrames) frames.push_back(millisecondsOf(step));
  const double memory_mb = usedMemory_mb() - before_mb;
  Cut cut;
  cut.revision = body.revision + 1;
  cut.patch = testing::planePatch(body.rest_vertices.colwise().mean(), {1.0, 0.2, 0.1}, 1.0);
  std::string reason;
  CuttableBody tets(body, {}, [&](const TetEdits& edits) { simulator->apply(edits); });
  const double cut_ms = millisecondsOf([&] {
    if (!tets.apply(cut, {}, &reason)) throw std::runtime_error(reason);
    for (int k = 1; k <= 2; ++k) simulator->step(targets[static_cast<std::size_t>(k)], frame++ * kFrame);
  });
  return fmt::format(
      R"({{"tets": {}, "solver_ms": {}, "frame_ms": {}, "prepare_ms": {}, "cut_ms": {}, "memory_mb": {}}})",
      body.tets.rows(), solver_ms, median(&frames), prepare_ms, cut_ms, memory_mb);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc != 3)
      throw std::invalid_argument("usage: measure_growth tets CELLS | measure_growth pieces COUNT");
    const TetTopology body =
        argv[1] == std::string("pieces") ? boxes(std::stoi(argv[2])) : cube(std::stoi(argv[2]));
    fmt::print("{}\n", measured(body, solverFrame_ms(body)));
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
  return 0;
}
