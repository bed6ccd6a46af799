#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "bench/peers/cgal_closest_point.h"
#include "bench/peers/cgal_triangulation.h"
#include "bench/wall_time.h"
#include "plane/constrained_triangulation.h"
#include "softbody_common/statistics/median.h"
#include "softbody_sim/object/object_model.h"
#include "softbody_sim/object/visual_mesh.h"
#include "softbody_sim/surface_mesh/closest_point.h"

/// Triangulation of a cut's section and closest points on a surface, in turn with CGAL's own.
namespace {

using namespace softbody;
using bench::secondsOf;

/// The outline of a cut's section, with points inside it.
struct Section {
  std::vector<Eigen::Vector2d> points;
  std::vector<std::array<int, 2>> outline;
};

Section makeSection(int vertices) {
  Section section;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const auto at = [](double angle, double share) -> Eigen::Vector2d {
    return share * (0.1 + 0.02 * std::sin(5.0 * angle)) * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  };
  for (int k = 0; k < vertices / 2; ++k) {
    section.points.push_back(at(4.0 * M_PI * k / vertices, 1.0));
    section.outline.push_back({k, (k + 1) % (vertices / 2)});
  }
  for (int k = vertices / 2; k < vertices; ++k)
    section.points.push_back(at(2.0 * M_PI * uniform(random), 0.9 * std::sqrt(uniform(random))));
  return section;
}

void triangulateSection(benchmark::State& state) {
  const Section section = makeSection(static_cast<int>(state.range(0)));
  std::vector<double> ratios;
  for (auto _ : state) {
    const double ours =
        secondsOf([&] { benchmark::DoNotOptimize(triangulatePlane(section.points, section.outline)); });
    const double cgal = secondsOf(
        [&] { benchmark::DoNotOptimize(bench::cgalTriangulation(section.points, section.outline)); });
    ratios.push_back(cgal / ours);
    state.SetIterationTime(ours);
  }
  const auto ours = triangulatePlane(section.points, section.outline);
  state.counters["triangles"] = static_cast<double>(ours->triangles.size());
  state.counters["triangles of CGAL"] =
      static_cast<double>(bench::cgalTriangulation(section.points, section.outline));
  state.counters["summary/triangulation_ratio/" + std::to_string(state.range(0))] = medianOf(ratios);
}
BENCHMARK(triangulateSection)
    ->ArgName("vertices")
    ->Arg(100)
    ->Arg(2000)
    ->Unit(benchmark::kMicrosecond)
    ->UseManualTime()
    ->Iterations(99);

/// The shipped doll's surface.
TriangleMesh dollSurface() {
  Warnings warnings;
  const MeshTopology doll =
      loadVisualMesh(loadObjectDescription(SOFTBODY_CONFIG_DIR "/doll.yaml"), &warnings);
  return {doll.rest_vertices, doll.triangles};
}

/// Within 5 mm of the vertices: contacts and differences of surfaces ask for such points.
Points pointsNear(const Points& vertices, int count) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-0.005, 0.005);
  Points points(count, 3);
  for (auto point : points.rowwise()) {
    point = vertices.row(static_cast<Eigen::Index>(random() % static_cast<unsigned>(vertices.rows())));
    for (double& x : point) x += uniform(random);
  }
  return points;
}

void findClosestPoints(benchmark::State& state) {
  const TriangleMesh mesh = dollSurface();
  const Points points = pointsNear(mesh.vertices, 1000);
  const ClosestPointQuery query(mesh.vertices, mesh.triangles);
  const bench::CgalClosestPoint peer(mesh);
  Points ours(points.rows(), 3), cgal = ours;
  std::vector<double> ratios;
  for (auto _ : state) {
    const double time = secondsOf([&] {
      for (Eigen::Index p = 0; p < points.rows(); ++p) ours.row(p) = query.closest(points.row(p)).position;
    });
    const double peer_time = secondsOf([&] {
      for (Eigen::Index p = 0; p < points.rows(); ++p) cgal.row(p) = peer.closest(points.row(p));
    });
    ratios.push_back(peer_time / time);
    state.SetIterationTime(time);
  }
  const auto distances = [&points](const Points& places) {
    return Eigen::VectorXd((places - points).rowwise().norm());
  };
  state.counters["difference of distances"] = (distances(ours) - distances(cgal)).cwiseAbs().maxCoeff();
  state.counters["summary/closest_point_ratio"] = medianOf(ratios);
}
BENCHMARK(findClosestPoints)->Unit(benchmark::kMicrosecond)->UseManualTime()->Iterations(21);

}  // namespace

BENCHMARK_MAIN();
