#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cutting/fixtures/cut_visual_body.h"
#include "cutting/fixtures/same_topology.h"
#include "cutting/fixtures/surface_meshes.h"

namespace softbody {
namespace {

using testing::CutBody;
using testing::kRounding;
using testing::planePatch;
using testing::stateOf;
using testing::worstJump;

TEST(CutVisualBody, CutsWithoutAJump) {
  CutBody body;
  const Points before = body.shown();
  const CutPatch patch = planePatch({0.093, 0.05, 0.015}, {1.0, 0.3, 0.1}, 1.0);
  std::vector<bool> accounted = testing::cornersOfCrossedTriangles(body.surface().topology(), patch);
  ASSERT_TRUE(body.cut(patch, 1));
  const Points after = body.shown();
  const MeshTopology& mesh = body.surface().topology();
  for (Eigen::Index v = 0; v < after.rows(); ++v) {
    const int parent = mesh.vertex_parents[static_cast<std::size_t>(v)];
    if (parent < 0) continue;
    EXPECT_LT((after.row(v) - before.row(parent)).norm(), 1e-9);
    accounted[static_cast<std::size_t>(parent)] = true;
  }
  EXPECT_EQ(std::count(accounted.begin(), accounted.end(), false), 0)
      << "vertices away from the cut are gone";
  EXPECT_LT((body.atRest() - mesh.rest_vertices).cwiseAbs().maxCoeff(), kRounding);
}

/// Largest elongation of an edge of the mesh when the pieces of tets are moved apart [m].
double stretchWhenApart(const CutBody& body, double distance) {
  const TetTopology& tets = body.tets();
  Points apart = tets.rest_vertices;
  for (Eigen::Index t = 0; t < tets.tets.rows(); ++t) {
    for (const int v : tets.tets.row(t)) {
      apart(v, 2) = tets.rest_vertices(v, 2) + distance * tets.tet_pieces[static_cast<std::size_t>(t)];
    }
  }
  const Points shown = body.surface().apply(stateOf(tets, apart)).vertices;
  const MeshTopology& mesh = body.surface().topology();
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

TEST(CutVisualBody, PiecesDoNotMixAtRandomCuts) {
  const TetTopology sponge = testing::sponge();
  testing::RandomCuts cuts(sponge, 5);
  int parted = 0, counts_differ = 0;
  for (int k = 0; k < 80; ++k) {
    CutBody body;
    if (!body.cut(cuts.planeCut(), 1)) continue;
    const auto& pieces = body.tets().tet_pieces;
    const auto& visual = body.surface().topology().triangle_pieces;
    const auto tet_pieces = *std::max_element(pieces.begin(), pieces.end()) + 1;
    const auto visual_pieces = *std::max_element(visual.begin(), visual.end()) + 1;
    parted += tet_pieces > 1;
    counts_differ += tet_pieces != visual_pieces;
    EXPECT_LT(stretchWhenApart(body, 0.05), kRounding) << k;
    EXPECT_LT((body.atRest() - body.surface().topology().rest_vertices).cwiseAbs().maxCoeff(), kRounding);
  }
  EXPECT_EQ(counts_differ, 0);
  EXPECT_GT(parted, 40);
}

/// A half plane: the cut of a blade that has entered up to `center`, along `way`.
CutPatch halfPlane(const Eigen::Vector3d& center, const Eigen::Vector3d& normal, const Eigen::Vector3d& way) {
  const Eigen::Vector3d across = normal.cross(way);
  Points before(2, 3), now(2, 3);
  before << (center - way - across).transpose(), (center - way + across).transpose();
  now << (center - across).transpose(), (center + across).transpose();
  return ruledPatch(before, now);
}

/// The side of a plane of each vertex, 1 or -1: the side of its triangles, or of their backs if they lie in
/// the plane.
std::vector<int> sidesOf(const MeshTopology& mesh, const Eigen::Vector3d& center,
                         const Eigen::Vector3d& normal) {
  const Points normals = vertexNormals(mesh.rest_vertices, mesh.triangles);
  std::vector<double> sides(static_cast<std::size_t>(normals.rows()), 0.0);
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    double height = 0.0;
    for (const int v : mesh.triangles.row(t))
      height += normal.dot(mesh.rest_vertices.row(v).transpose() - center);
    for (const int v : mesh.triangles.row(t)) {
      const double own = mesh.cut[static_cast<std::size_t>(t)] ? -1e-9 * normal.dot(normals.row(v)) : height;
      sides[static_cast<std::size_t>(v)] += own;
    }
  }
  std::vector<int> signs;
  for (const double side : sides) signs.push_back(side > 0.0 ? 1 : -1);
  return signs;
}

/// Opens a slit: displacements grow with the distance from its front and are 0 within `margin` of it.
Points opened(const TetTopology& tets, const Eigen::Vector3d& center, const Eigen::Vector3d& normal,
              const Eigen::Vector3d& way, double margin) {
  std::vector<double> sides(static_cast<std::size_t>(tets.rest_vertices.rows()), 0.0);
  for (const auto& tet : tets.tets.rowwise()) {
    for (const int v : tet) {
      for (const int w : tet)
        sides[static_cast<std::size_t>(v)] += normal.dot(tets.rest_vertices.row(w).transpose() - center);
    }
  }
  Points vertices = tets.rest_vertices;
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
    const double behind = way.dot(center - tets.rest_vertices.row(v).transpose()) - margin;
    vertices.row(v) +=
        std::copysign(std::max(0.0, behind), sides[static_cast<std::size_t>(v)]) * normal.transpose();
  }
  return vertices;
}

TEST(CutVisualBody, SlitsOpenWithTheirTets) {
  const TetTopology sponge = testing::sponge();
  testing::RandomCuts cuts(sponge, 7);
  constexpr double kMargin = 0.04;  // larger than the edge of a tet
  int slits = 0, checked = 0, other_side = 0;
  for (int k = 0; k < 80; ++k) {
    const Eigen::Vector3d center = cuts.point(), normal = cuts.direction();
    const Eigen::Vector3d way = normal.cross(cuts.direction()).normalized();
    CutBody body;
    if (!body.cut(halfPlane(center, normal, way), 1)) continue;
    ++slits;
    const MeshTopology& mesh = body.surface().topology();
    const Points vertices = opened(body.tets(), center, normal, way, kMargin);
    const Points shown = body.surface().apply(stateOf(body.tets(), vertices)).vertices;
    const std::vector<int> sides = sidesOf(mesh, center, normal);
    for (Eigen::Index v = 0; v < shown.rows(); ++v) {
      const double behind = way.dot(center - mesh.rest_vertices.row(v).transpose()) - kMargin;
      if (behind < 0.01) continue;
      ++checked;
      const double moved = normal.dot(shown.row(v) - mesh.rest_vertices.row(v));
      other_side += sides[static_cast<std::size_t>(v)] * moved < 0.4 * behind;
    }
  }
  EXPECT_GT(slits, 40);
  EXPECT_GT(checked, 5000);
  // Flaps of a few millimetres, thinner than the tets, stay with the material below.
  EXPECT_LE(other_side, checked / 1000);
}

TEST(CutVisualBody, StrokesGoOnWithoutAJump) {
  const TetTopology sponge = testing::sponge();
  testing::RandomCuts cuts(sponge, 9);
  int steps = 0;
  for (int k = 0; k < 20; ++k) {
    CutBody body;
    for (const CutPatch& patch : cuts.sweep(6)) {
      const MeshTopology mesh = body.surface().topology();
      const Points shown = body.shown();
      if (!body.cut(patch, 1)) continue;
      ++steps;
      const MeshTopology& after = body.surface().topology();
      EXPECT_LT(worstJump(shown, mesh, body.shown(), after), 1e-9) << "stroke " << k;
      EXPECT_LT((body.atRest() - after.rest_vertices).cwiseAbs().maxCoeff(), kRounding);
      // The body continues to move during the cut.
      body.vertices.col(2) += 0.02 * body.vertices.col(0).cwiseAbs2() / 0.2;
    }
  }
  EXPECT_GT(steps, 50);
}

TEST(CutVisualBody, FollowsAffineDeformationsExactly) {
  CutBody body;
  body.vertices = body.tets().rest_vertices;
  ASSERT_TRUE(body.cut(planePatch({0.093, 0.05, 0.015}, {1.0, 0.3, 0.1}, 1.0), 1));
  ASSERT_TRUE(body.cut(planePatch({0.1, 0.05, 0.015}, {0.1, 1.0, 0.1}, 1.0), 2));
  Eigen::Matrix3d A;
  A << 1.2, 0.3, -0.1, 0.0, 0.8, 0.2, 0.1, -0.2, 1.1;
  const TetTopology& tets = body.tets();
  const VisualSurface& surface = body.surface();
  const Points shown = surface.apply(stateOf(tets, tets.rest_vertices * A.transpose())).vertices;
  EXPECT_LT((shown - surface.topology().rest_vertices * A.transpose()).cwiseAbs().maxCoeff(), 1e-7);
}

/// Compares everything except the revision.
TEST(CutVisualBody, UndoesFiveCutsBitForBitAndRedoesThem) {
  CutBody body;
  std::vector<VisualSurface> surfaces{body.surface()};
  std::vector<Points> states{body.vertices}, shown{body.shown()};
  const TetTopology sponge = testing::sponge();
  testing::RandomCuts cuts(sponge, 11);
  for (std::uint32_t stroke = 1; surfaces.size() < 6; ++stroke) {
    if (!body.cut(cuts.planeCut(), stroke)) continue;
    surfaces.push_back(body.surface());
    states.push_back(body.vertices);
    shown.push_back(body.shown());
  }
  const auto expectVersion = [&](std::size_t version) {
    EXPECT_EQ(body.surface().topology().revision, body.tets().revision);
    body.vertices = states[version];
    testing::expectSame(body.surface().topology(), surfaces[version].topology());
    EXPECT_EQ(body.shown(), shown[version]);
  };
  for (std::size_t version = 5; version-- > 0;) {
    EXPECT_TRUE(body.apply(CutKind::kUndo));
    expectVersion(version);
  }
  EXPECT_FALSE(body.apply(CutKind::kUndo));
  for (std::size_t version = 1; version <= 5; ++version) {
    EXPECT_TRUE(body.apply(CutKind::kRedo));
    expectVersion(version);
  }
  EXPECT_FALSE(body.apply(CutKind::kRedo));
  EXPECT_TRUE(body.apply(CutKind::kReset));
  expectVersion(0);
}

}  // namespace
}  // namespace softbody
