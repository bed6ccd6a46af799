#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "bench/bent_bodies.h"
#include "bench/doll_size.h"
#include "bench/machine_limits.h"
#include "bench/wall_time.h"
#include "elasticity/elastic_blocks.h"
#include "linear_solvers/global_step_solver.h"
#include "softbody_sim/interpolation/tiled_weights.h"
#include "tets/tet_matrix.h"

/// How near the three hottest loops are to what this machine can do: bytes and operations of each loop, by
/// the formulas in docs/metrics.md, divided by the time and by the bandwidth and peak that are measured here.
namespace {

using namespace softbody;
using bench::BentBody;

constexpr std::size_t kMemory_bytes = std::size_t{384} << 20;  // of the triad: more than a core's caches hold
constexpr int kRuns = 300;  // of each loop; the shortest counts, as for the machine's limits

/// What one run of a loop takes.
struct Work {
  double bytes;             ///< read or written in memory of this size or a larger one
  double operations;        ///< a multiply-add counts as two
  std::size_t working_set;  ///< [bytes]
};

template <typename Run>
void report(benchmark::State& state, const std::string& name, const Work& work, const Run& run) {
  double least = 1e9, reading = bench::readBandwidth(work.working_set);
  for (auto _ : state) {
    for (int k = 0; k < kRuns; ++k) least = std::min(least, bench::secondsOf(run));
    state.SetIterationTime(least);
  }
  reading = std::max(reading, bench::readBandwidth(work.working_set));
  const double bytes = work.bytes / least, operations = work.operations / least;
  state.counters["GB/s"] = 1e-9 * bytes;
  state.counters["GB/s of reading alone"] = 1e-9 * reading;
  state.counters["Gflop/s"] = 1e-9 * operations;
  state.counters[fmt::format("summary/limits/{}/bandwidth", name)] = bytes / reading;
  state.counters[fmt::format("summary/limits/{}/arithmetic", name)] = operations / bench::peakOperations();
}

void machine(benchmark::State& state) {
  for (auto _ : state) {
    state.counters["summary/limits/triad_GB_s"] = 1e-9 * bench::triadBandwidth(kMemory_bytes);
    state.counters["summary/limits/peak_Gflop_s"] = 1e-9 * bench::peakOperations();
  }
}

/// Mean number of Newton iterations to the trace of a tet's rotation, as in corotated-inl.h.
double meanIterations(const BentBody& body) {
  const Points& rest = body.topology.rest_vertices;
  int sum = 0;
  for (const auto& tet : body.topology.tets.rowwise()) {
    Eigen::Matrix3d from, to;
    for (int k = 0; k < 3; ++k) {
      from.col(k) = (rest.row(tet[k + 1]) - rest.row(tet[0])).transpose();
      to.col(k) = (body.start.row(tet[k + 1]) - body.start.row(tet[0])).transpose();
    }
    const Eigen::Matrix3d F = to * from.inverse(), C = F.determinant() * F.inverse().transpose();
    double trace = std::sqrt(3.0 * F.squaredNorm()), step = trace;
    while (std::abs(step) >= 3e-4 * trace) {
      const double gap = trace * trace - F.squaredNorm();
      step = (gap * gap - 8.0 * F.determinant() * trace - 4.0 * C.squaredNorm()) /
             (4.0 * trace * gap - 8.0 * F.determinant());
      trace -= step;
      ++sum;
    }
  }
  return static_cast<double>(sum) / static_cast<double>(body.topology.tets.rows());
}

void localStep(benchmark::State& state, const std::string& name) {
  const BentBody body = bench::bentBody(bench::bodyTopology(name), 0.3);
  const CorotatedElasticity elasticity(body.topology.rest_vertices, body.topology.tets, body.lame);
  ElasticBlocks<float> blocks(body.topology.rest_vertices, elasticity, Simd::kAuto);
  Rows<float> x = Rows<float>::Zero(paddedRows(body.start.rows()), 4), gradient = x;
  x.topLeftCorner(body.start.rows(), 3) = body.start.cast<float>();
  const auto tets = static_cast<double>(body.topology.tets.rows()),
             vertices = static_cast<double>(body.start.rows());
  const double block = sizeof(TetBlock<float>) / static_cast<double>(TetBlock<float>::kLanes);
  const double bytes = block * tets + 3.0 * 4.0 * sizeof(float) * vertices;
  report(state, "local_step/" + name,
         {bytes, (307.0 + 12.0 * meanIterations(body)) * tets, static_cast<std::size_t>(bytes)},
         [&] { benchmark::DoNotOptimize(blocks.addTo(x, &gradient)); });
}

/// Numbers in the factor's lower triangle.
double factorSize(const TetMatrix& metric) {
  PositiveDefiniteSolver solver(metric.lower());
  solver.factorize(metric.lower());
  double size = 0.0;
  for (int k = 0; k < solver.supernodeCount(); ++k) {
    const Supernode node = solver.supernode(k);
    size += 0.5 * node.width() * (node.width() + 1) + static_cast<double>(node.width()) * node.below();
  }
  return size;
}

void globalStep(benchmark::State& state, const std::string& name) {
  const BentBody body = bench::bentBody(bench::bodyTopology(name), 0.3);
  const TetMatrix metric = bench::metricOf(body);
  GlobalStepSolver<float> solver(metric.lower(), Simd::kAuto);
  solver.factorize(metric.lower());
  const Rows<float> b = Rows<float>::Ones(paddedRows(body.start.rows()), 4);
  Rows<float> x = b;
  const double numbers = factorSize(metric);
  report(state, "global_step/" + name,
         {2.0 * sizeof(std::uint16_t) * numbers, 2.0 * 3.0 * 2.0 * numbers,
          static_cast<std::size_t>(sizeof(std::uint16_t) * numbers)},
         [&] { solver.solve(b, &x); });
}

void interpolation(benchmark::State& state) {
  const bench::DollSize doll = bench::makeDollSize();
  const Eigen::Index columns = doll.cage.vertices.rows(), rows = doll.points.rows();
  TiledWeights weights(columns);
  for (Eigen::Index p = 0; p < rows; ++p) weights.append(Eigen::RowVectorXd::Random(columns));
  const TiledWeights::Values values = TiledWeights::Values::Random(columns, 4);
  TiledWeights::Products products;
  const auto numbers = static_cast<double>(rows * columns);
  report(state, "mean_value/doll",
         {sizeof(float) * numbers, 2.0 * 4.0 * numbers, static_cast<std::size_t>(sizeof(float) * numbers)},
         [&] { weights.multiply(values, &products); });
}

template <typename Measure>
void add(const std::string& name, Measure measure) {
  benchmark::RegisterBenchmark(name.c_str(), measure)
      ->UseManualTime()
      ->Iterations(1)
      ->Unit(benchmark::kMicrosecond);
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  add("machine", machine);
  for (const std::string body : {"10k", "100k"}) {
    add("local_step/" + body, [body](benchmark::State& s) { localStep(s, body); });
    add("global_step/" + body, [body](benchmark::State& s) { globalStep(s, body); });
  }
  add("mean_value/doll", interpolation);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
