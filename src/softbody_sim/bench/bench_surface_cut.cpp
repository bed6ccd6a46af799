#include <benchmark/benchmark.h>

#include <stdexcept>

#include "../test/cutting/surface_meshes.h"
#include "core/cutting/surface_cut.h"

namespace {

using namespace softbody;

/// From the patch to the cut visual mesh: a plane through the middle, a little oblique, all the way or half.
void cutVisualMesh(benchmark::State& state, const std::string& name, double reach) {
  const MeshTopology mesh = testing::loadMesh(SOFTBODY_SOURCE_DIR "/../softbody_bringup/config/" + name);
  const Eigen::Vector3d center = mesh.rest_vertices.colwise().mean();
  const Eigen::Vector3d normal = Eigen::Vector3d(1.0, 0.2, 0.1).normalized();
  const Eigen::Vector3d u = normal.unitOrthogonal(), v = normal.cross(u);
  Points before(2, 3), now(2, 3);
  before << (center - u - v).transpose(), (center - u + v).transpose();
  now << (center + reach * u - v).transpose(), (center + reach * u + v).transpose();
  const CutPatch patch = ruledPatch(before, now);
  for (auto _ : state) {
    const SurfaceCut cut = cutSurface(mesh, patch);
    if (cut.outcome != CutOutcome::kCut) throw std::runtime_error(cut.reason);
    benchmark::DoNotOptimize(cut.mesh.triangles.data());
  }
}

BENCHMARK_CAPTURE(cutVisualMesh, sponge_522_vertices, "sponge.obj", 1.0)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(cutVisualMesh, sponge_522_vertices_halfway, "sponge.obj", 0.0)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(cutVisualMesh, doll_18650_vertices, "doll.obj", 1.0)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(cutVisualMesh, doll_18650_vertices_halfway, "doll.obj", 0.0)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
