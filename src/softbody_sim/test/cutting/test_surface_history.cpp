#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>

#include "core/cutting/cut_history.h"
#include "core/cutting/surface_history.h"
#include "cutting/cut_bodies.h"
#include "softbody_common/tet_locator.h"

namespace softbody {
namespace {

using testing::planePatch;

constexpr double kRounding = 2e-8;  ///< [m] of coordinates in single precision

/// The surface of a box as a visual mesh: vertices 10 mm apart, a little inside of the tets.
MeshTopology visualSponge() {
  const TetTopology box = testing::boxTopology({20, 10, 3}, {0.2, 0.1, 0.03});
  std::vector<int> numbers(static_cast<std::size_t>(box.rest_vertices.rows()), -1);
  MeshTopology mesh;
  mesh.triangles = box.surface;
  int count = 0;
  for (int& v : mesh.triangles.reshaped()) {
    int& number = numbers[static_cast<std::size_t>(v)];
    if (number < 0) {
      number = count++;
      mesh.rest_vertices.conservativeResize(count, Eigen::NoChange);
      mesh.rest_vertices.row(number) = box.rest_vertices.row(v);
      mesh.vertex_parents.push_back(number);
    }
    v = number;
  }
  const Eigen::RowVector3d center(0.1, 0.05, 0.015);
  mesh.rest_vertices = (0.96 * (mesh.rest_vertices.rowwise() - center)).rowwise() + center;
  mesh.rest_vertices = inSinglePrecision(mesh.rest_vertices);
  mesh.bodies.assign(static_cast<std::size_t>(mesh.triangles.rows()), 0);
  mesh.cut.assign(static_cast<std::size_t>(mesh.triangles.rows()), false);
  return mesh;
}

MeshState stateOf(const TetTopology& volume, const Points& vertices) {
  MeshState state;
  state.revision = volume.revision;
  state.vertices = vertices;
  state.confidence.assign(static_cast<std::size_t>(vertices.rows()), 1.0f);
  return state;
}

/// Bent, twisted and a little uneven, by centimetres.
Points deformed(const Points& rest) {
  Points points = rest;
  for (Eigen::Index v = 0; v < rest.rows(); ++v) {
    const double x = rest(v, 0), y = rest(v, 1), z = rest(v, 2);
    points.row(v) << x - 0.5 * z * x, y + 0.004 * std::sin(40.0 * x) - 2.0 * z * x,
        z + 3.0 * x * x + 2.0 * x * y;
  }
  return points;
}

/// A body whose tets and visual mesh are cut together.
struct Body {
  explicit Body(const TetTopology& uncut = testing::sponge(), const MeshTopology& visual = visualSponge())
      : tets(uncut), surface(VisualSurface(visual, uncut)), vertices(deformed(uncut.rest_vertices)) {}

  MeshState state() const { return stateOf(tets.topology(), vertices); }
  Points shown() const { return surface.surface().apply(state()).vertices; }
  Points atRest() const {
    return surface.surface().apply(stateOf(tets.topology(), tets.topology().rest_vertices)).vertices;
  }

  /// @return whether both were cut.
  bool cut(const CutPatch& patch, std::uint32_t stroke) {
    const SurfaceCut mesh = surface.preview(patch, stroke);
    if (mesh.outcome == CutOutcome::kRefused) return false;
    const TetTopology before = tets.topology();
    std::string reason;
    const auto edit = tets.cut(patch, stroke, &reason);
    if (!edit) {
      surface.advance(patch, stroke);
      return false;
    }
    surface.cut(patch, stroke, mesh, *edit, stateOf(before, vertices));
    vertices = applyBinding(edit->vertex_origins, vertices, before.tets);
    return mesh.outcome == CutOutcome::kCut;
  }

  CutHistory tets;
  SurfaceHistory surface;
  Points vertices;  ///< of the tets, deformed
};

TEST(SurfaceHistory, CutsWithoutAJump) {
  Body body;
  const Points before = body.shown();
  ASSERT_TRUE(body.cut(planePatch({0.093, 0.05, 0.015}, {1.0, 0.3, 0.1}, 1.0), 1));
  const Points after = body.shown();
  const MeshTopology& mesh = body.surface.surface().topology();
  int kept = 0;
  for (Eigen::Index v = 0; v < after.rows(); ++v) {
    const int parent = mesh.vertex_parents[static_cast<std::size_t>(v)];
    if (parent < 0) continue;
    EXPECT_LT((after.row(v) - before.row(parent)).norm(), 1e-9);
    ++kept;
  }
  EXPECT_GE(kept, before.rows());
  EXPECT_LT((body.atRest() - mesh.rest_vertices).cwiseAbs().maxCoeff(), kRounding);
}

/// By how much an edge of the mesh is stretched at most where the pieces of tets are moved apart [m].
double stretchWhenApart(const Body& body, double distance) {
  const TetTopology& tets = body.tets.topology();
  Points apart = tets.rest_vertices;
  for (Eigen::Index t = 0; t < tets.tets.rows(); ++t) {
    for (const int v : tets.tets.row(t)) {
      apart(v, 2) = tets.rest_vertices(v, 2) + distance * tets.bodies[static_cast<std::size_t>(t)];
    }
  }
  const Points shown = body.surface.surface().apply(stateOf(tets, apart)).vertices;
  const MeshTopology& mesh = body.surface.surface().topology();
  double worst = 0.0;
  for (const auto& triangle : mesh.triangles.rowwise()) {
    for (int k = 0; k < 3; ++k) {
      const int a = triangle[k], b = triangle[(k + 1) % 3];
      worst = std::max(worst, (shown.row(a) - shown.row(b)).norm() -
                                  (mesh.rest_vertices.row(a) - mesh.rest_vertices.row(b)).norm());
    }
  }
  return worst;
}

TEST(SurfaceHistory, PiecesDoNotMixAtRandomCuts) {
  const TetTopology sponge = testing::sponge();
  testing::RandomCuts cuts(sponge, 5);
  int parted = 0, counts_differ = 0;
  for (int k = 0; k < 200; ++k) {
    Body body;
    if (!body.cut(cuts.planeCut(), 1)) continue;
    const auto& bodies = body.tets.topology().bodies;
    const auto& visual = body.surface.surface().topology().bodies;
    const auto tet_pieces = *std::max_element(bodies.begin(), bodies.end()) + 1;
    const auto visual_pieces = *std::max_element(visual.begin(), visual.end()) + 1;
    parted += tet_pieces > 1;
    counts_differ += tet_pieces != visual_pieces;
    EXPECT_LT(stretchWhenApart(body, 0.05), kRounding) << k;
    EXPECT_LT((body.atRest() - body.surface.surface().topology().rest_vertices).cwiseAbs().maxCoeff(),
              kRounding);
  }
  EXPECT_EQ(counts_differ, 0);
  EXPECT_GT(parted, 100);
}

}  // namespace
}  // namespace softbody
