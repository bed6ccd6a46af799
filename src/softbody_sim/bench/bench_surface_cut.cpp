#include <benchmark/benchmark.h>

#include <stdexcept>
#include <string>

#include "cutting/binding/surface_rebinding.h"
#include "cutting/fixtures/surface_meshes.h"
#include "cutting/volume/tet_cutter.h"
#include "softbody_sim/cutting/binding/cuttable_body.h"
#include "softbody_sim/dynamics/simulator.h"
#include "softbody_sim/object/object_model.h"

namespace {

using namespace softbody;

const std::string kConfig = SOFTBODY_SOURCE_DIR "/../softbody_bringup/config/";

/// A slightly oblique plane that ends in the middle of the body (reach 0) or a metre beyond (1).
CutPatch planeThrough(const MeshTopology& mesh, double reach) {
  const Eigen::Vector3d center = mesh.rest_vertices.colwise().mean();
  const Eigen::Vector3d normal = Eigen::Vector3d(1.0, 0.2, 0.1).normalized();
  const Eigen::Vector3d u = normal.unitOrthogonal(), v = normal.cross(u);
  Points before(2, 3), now(2, 3);
  before << (center - u - v).transpose(), (center - u + v).transpose();
  now << (center + reach * u - v).transpose(), (center + reach * u + v).transpose();
  return ruledPatch(before, now);
}

ManifoldMesh manifoldOf(const MeshTopology& mesh) {
  return splitNonManifold(listOf(mesh.triangles), mesh.rest_vertices);
}

/// Cuts the visual mesh.
void cutVisualMesh(benchmark::State& state, const std::string& name, double reach) {
  const MeshTopology mesh = testing::loadMesh(kConfig + name);
  const ManifoldMesh manifold = manifoldOf(mesh);
  const CutPatch patch = planeThrough(mesh, reach);
  for (auto _ : state) {
    const SurfaceCut cut = cutSurface(mesh, manifold, patch);
    if (cut.outcome != CutOutcome::kCut) throw std::runtime_error(cut.reason);
    benchmark::DoNotOptimize(cut.mesh.triangles.data());
  }
}

/// A body to cut: tets, visual mesh and its binding.
struct CutBody {
  CutBody(const std::string& name, double reach)
      : model(buildObjectModel(loadObjectDescription(kConfig + name))),
        surface(model.visual, model.volume),
        sources(ownSources(model.visual.rest_vertices.rows())),
        manifold(manifoldOf(model.visual)),
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
  std::vector<int> sources;
  ManifoldMesh manifold;
  std::vector<bool> uncut;
  CutPatch patch;
  MeshState bent;
};

void cutAll(benchmark::State& state, const std::string& name, double reach) {
  const CutBody body(name, reach);
  for (auto _ : state) {
    const TetEdit edit = body.cutTetsOnce();
    SurfaceCut cut = cutSurface(body.model.visual, body.manifold, body.patch);
    benchmark::DoNotOptimize(rebindSurface(body.surface, body.sources, std::move(cut), edit, body.bent));
  }
}

void bindCutMesh(benchmark::State& state, const std::string& name, double reach) {
  const CutBody body(name, reach);
  const TetEdit edit = body.cutTetsOnce();
  const SurfaceCut cut = cutSurface(body.model.visual, body.manifold, body.patch);
  for (auto _ : state)
    benchmark::DoNotOptimize(rebindSurface(body.surface, body.sources, cut, edit, body.bent));
}

constexpr double kBladeHeight = 0.045;  // [m]

/// Simulator and surface of a body at rest, with a blade across its middle.
class BodyUnderBlade {
 public:
  explicit BodyUnderBlade(const ObjectModel& model)
      : rest_(model.visual.rest_vertices),
        simulator_(model.volume, model.material, {}),
        surface_(model.visual, model.volume, {}, [this](const TetEdits& edits) { simulator_.apply(edits); }) {
    TargetSet targets;
    targets.reset = true;
    simulator_.step(targets, 0);
  }

  /// Undoes all cuts and moves the blade 5 mm above the body.
  void lift() {
    std::string reason;
    surface_.apply(surface_.edit(CutKind::kReset), simulator_.state(), &reason);
    stamp_ += 1'000'000'000;
    if (surface_.follow(bladeAt(-0.005), simulator_.state(), stamp_))
      throw std::runtime_error("cut from above");
  }

  /// Cuts with a new blade pose. @return state of the cut visual mesh.
  MeshState moveTo(double share_of_height) {
    const double depth = share_of_height * (rest_.col(2).maxCoeff() - rest_.col(2).minCoeff());
    const auto cut = surface_.follow(bladeAt(depth), simulator_.state(), stamp_);
    if (!cut) throw std::runtime_error("the blade does not cut");
    return surface_.surface().apply(simulator_.state());
  }

 private:
  Points bladeAt(double depth) const {
    const Eigen::RowVector3d low = rest_.colwise().minCoeff(), high = rest_.colwise().maxCoeff();
    const Eigen::RowVector3d edge(0.47 * low.x() + 0.53 * high.x(), 0.0, high.z() - depth);
    Points blade(4, 3);
    blade.row(0) = edge + Eigen::RowVector3d(0.0, low.y() - 0.02, 0.0);
    blade.row(1) = edge + Eigen::RowVector3d(0.0, high.y() + 0.02, 0.0);
    blade.row(2) = blade.row(1) + Eigen::RowVector3d(0.0, 0.0, kBladeHeight);
    blade.row(3) = blade.row(0) + Eigen::RowVector3d(0.0, 0.0, kBladeHeight);
    return blade;
  }

  Points rest_;
  Simulator simulator_;
  CuttableBody surface_;
  Nanoseconds stamp_ = 0;
};

/// A frame in which the blade moves from one depth to another, as fractions of the body's height.
void bladeContact(benchmark::State& state, const std::string& name, double from, double to) {
  BodyUnderBlade body(buildObjectModel(loadObjectDescription(kConfig + name)));
  for (auto _ : state) {
    state.PauseTiming();
    body.lift();
    if (from > 0.0) body.moveTo(from);
    state.ResumeTiming();
    benchmark::DoNotOptimize(body.moveTo(to));
  }
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

BENCHMARK_CAPTURE(bladeContact, sponge_522_vertices, "sponge.yaml", 0.0, 0.3)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(bladeContact, sponge_522_vertices_through, "sponge.yaml", 0.8, 1.1)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(bladeContact, doll_18650_vertices, "doll.yaml", 0.0, 0.5)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(bladeContact, doll_18650_vertices_through, "doll.yaml", 0.8, 1.1)
    ->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
