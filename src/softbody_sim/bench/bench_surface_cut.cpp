#include <benchmark/benchmark.h>

#include <stdexcept>

#include "../test/cutting/surface_meshes.h"
#include "core/cutting/surface_swap.h"
#include "core/cutting/tet_cutter.h"
#include "softbody_sim/object_model.h"

namespace {

using namespace softbody;

const std::string kConfig = SOFTBODY_SOURCE_DIR "/../softbody_bringup/config/";

/// A plane through the middle, a little oblique, that ends a metre beyond it (1) or there (0).
CutPatch planeThrough(const MeshTopology& mesh, double reach) {
  const Eigen::Vector3d center = mesh.rest_vertices.colwise().mean();
  const Eigen::Vector3d normal = Eigen::Vector3d(1.0, 0.2, 0.1).normalized();
  const Eigen::Vector3d u = normal.unitOrthogonal(), v = normal.cross(u);
  Points before(2, 3), now(2, 3);
  before << (center - u - v).transpose(), (center - u + v).transpose();
  now << (center + reach * u - v).transpose(), (center + reach * u + v).transpose();
  return ruledPatch(before, now);
}

/// From the patch to the cut visual mesh.
void cutVisualMesh(benchmark::State& state, const std::string& name, double reach) {
  const MeshTopology mesh = testing::loadMesh(kConfig + name);
  const CutPatch patch = planeThrough(mesh, reach);
  for (auto _ : state) {
    const SurfaceCut cut = cutSurface(mesh, patch);
    if (cut.outcome != CutOutcome::kCut) throw std::runtime_error(cut.reason);
    benchmark::DoNotOptimize(cut.mesh.triangles.data());
  }
}

/// From the patch to tets, visual mesh and its binding, and from the cut tets and mesh to the binding alone.
struct CutBody {
  CutBody(const std::string& name, double reach)
      : model(buildObjectModel(loadObjectDescription(kConfig + name))),
        surface(model.visual, model.volume),
        sources(ownSources(model.visual)),
        uncut(static_cast<std::size_t>(model.volume.surface.rows()), false),
        patch(planeThrough(model.visual, reach)) {
    bent.vertices = model.volume.rest_vertices;
    bent.vertices.col(2) += 3.0 * bent.vertices.col(0).cwiseAbs2();
    bent.confidence.assign(static_cast<std::size_t>(bent.vertices.rows()), 1.0f);
  }
  TetEdit cutTetsOnce() const {
    CutStroke stroke;
    std::string reason;
    auto edit = cutTets(model.volume, uncut, patch, {}, &stroke, &reason);
    if (!edit) throw std::runtime_error(reason);
    return *std::move(edit);
  }

  ObjectModel model;
  VisualSurface surface;
  MeshSources sources;
  std::vector<bool> uncut;
  CutPatch patch;
  MeshState bent;
};

void cutAll(benchmark::State& state, const std::string& name, double reach) {
  const CutBody body(name, reach);
  for (auto _ : state) {
    const TetEdit edit = body.cutTetsOnce();
    SurfaceCut cut = cutSurface(body.model.visual, body.patch);
    benchmark::DoNotOptimize(swapSurface(body.surface, body.sources, std::move(cut), edit, body.bent));
  }
}

void bindCutMesh(benchmark::State& state, const std::string& name, double reach) {
  const CutBody body(name, reach);
  const TetEdit edit = body.cutTetsOnce();
  const SurfaceCut cut = cutSurface(body.model.visual, body.patch);
  for (auto _ : state)
    benchmark::DoNotOptimize(swapSurface(body.surface, body.sources, cut, edit, body.bent));
}

BENCHMARK_CAPTURE(cutVisualMesh, sponge_522_vertices, "sponge.obj", 1.0)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(cutVisualMesh, sponge_522_vertices_halfway, "sponge.obj", 0.0)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(cutVisualMesh, doll_18650_vertices, "doll.obj", 1.0)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(cutVisualMesh, doll_18650_vertices_halfway, "doll.obj", 0.0)->Unit(benchmark::kMillisecond);

BENCHMARK_CAPTURE(bindCutMesh, sponge_522_vertices, "sponge.yaml", 1.0)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(bindCutMesh, doll_18650_vertices, "doll.yaml", 1.0)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(cutAll, sponge_522_vertices, "sponge.yaml", 1.0)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(cutAll, sponge_522_vertices_halfway, "sponge.yaml", 0.0)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(cutAll, doll_18650_vertices, "doll.yaml", 1.0)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(cutAll, doll_18650_vertices_halfway, "doll.yaml", 0.0)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
