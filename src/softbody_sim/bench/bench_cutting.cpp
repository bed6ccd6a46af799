#include <benchmark/benchmark.h>

#include <stdexcept>

#include "cutting/fixtures/cut_bodies.h"
#include "cutting/volume/tet_cutter.h"

namespace {

using namespace softbody;

/// Cuts the tets along a slightly oblique plane through the middle.
void cutInHalf(benchmark::State& state, const TetTopology& body) {
  const std::vector<bool> uncut(static_cast<std::size_t>(body.surface.rows()), false);
  const Eigen::Vector3d center = body.rest_vertices.colwise().mean();
  const CutPatch patch = testing::planePatch(center, {1.0, 0.2, 0.1}, 1.0);
  for (auto _ : state) {
    CutStroke stroke;
    std::string reason;
    const auto edit = cutTets(body, uncut, patch, {}, &stroke, &reason);
    if (!edit) throw std::runtime_error(reason);
    benchmark::DoNotOptimize(edit->topology.tets.data());
  }
}

/// One frame of a blade: 5 mm further into a body that is cut halfway.
void deepenCut(benchmark::State& state, const TetTopology& body) {
  const Eigen::Vector3d low = body.rest_vertices.colwise().minCoeff(),
                        high = body.rest_vertices.colwise().maxCoeff();
  const double x = 0.43 * low.x() + 0.57 * high.x(), middle = 0.5 * (low.y() + high.y());
  const auto ruled = [&](double from, double to) {
    Points before(2, 3), now(2, 3);
    before << x, from, -1.0, x, from, 1.0;
    now << x, to, -1.0, x, to, 1.0;
    return ruledPatch(before, now);
  };
  CutStroke half;
  std::string reason;
  const std::vector<bool> uncut(static_cast<std::size_t>(body.surface.rows()), false);
  const auto slit = cutTets(body, uncut, ruled(low.y() - 0.01, middle), {}, &half, &reason);
  if (!slit) throw std::runtime_error(reason);
  for (auto _ : state) {
    CutStroke stroke = half;
    benchmark::DoNotOptimize(
        cutTets(slit->topology, slit->cut, ruled(middle, middle + 0.005), {}, &stroke, &reason));
  }
}

const TetTopology kSponge = testing::sponge();
const TetTopology kTenThousand = testing::boxTopology({12, 12, 12}, {0.2, 0.2, 0.2});

BENCHMARK_CAPTURE(cutInHalf, sponge_300_tets, kSponge)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(cutInHalf, box_10368_tets, kTenThousand)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(deepenCut, sponge_300_tets, kSponge)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(deepenCut, box_10368_tets, kTenThousand)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
