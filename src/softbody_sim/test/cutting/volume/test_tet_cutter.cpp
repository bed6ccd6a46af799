#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "cutting/fixtures/cut_bodies.h"
#include "cutting/volume/manifold.h"
#include "cutting/volume/tet_cutter.h"

namespace softbody {
namespace {

using testing::planePatch;
using testing::RandomCuts;

constexpr SubdivisionSettings kSettings;

struct Body {
  TetTopology topology;
  std::vector<bool> cut = std::vector<bool>(static_cast<std::size_t>(topology.surface.rows()), false);
};

/// Checks a cut body: volume, orientation, slivers, manifold surface, pieces.
void expectSound(const TetEdit& edit, const TetTopology& before) {
  const TetTopology& after = edit.topology;
  const double volume = tetVolumes(before.rest_vertices, before.tets).sum();
  const Eigen::VectorXd volumes = tetVolumes(after.rest_vertices, after.tets);
  EXPECT_NEAR(volumes.sum() / volume, 1.0, 1e-6);
  EXPECT_NEAR(enclosedVolume(after.rest_vertices, after.surface) / volume, 1.0, 1e-6);
  EXPECT_EQ(after.rest_vertices, inSinglePrecision(after.rest_vertices));
  EXPECT_EQ(nonManifoldVertices(after.surface), std::vector<int>());
  EXPECT_EQ(after.surface, boundaryTriangles(after.tets));
  EXPECT_EQ(after.tet_pieces, tetPieces(after.tets, static_cast<int>(after.rest_vertices.rows())));
  EXPECT_EQ(edit.cut.size(), static_cast<std::size_t>(after.surface.rows()));
  EXPECT_EQ(after.vertex_parents.size(), static_cast<std::size_t>(after.rest_vertices.rows()));
  const std::set<int> used(after.tets.data(), after.tets.data() + after.tets.size());
  EXPECT_EQ(used.size(), static_cast<std::size_t>(after.rest_vertices.rows()));
}

/// Checks that new tets are not slivers and fill their parents, and that vertices lie at their origins.
void expectDescended(const TetEdit& edit, const TetTopology& before) {
  const TetTopology& after = edit.topology;
  const Eigen::VectorXd old_volumes = tetVolumes(before.rest_vertices, before.tets);
  const Eigen::VectorXd volumes = tetVolumes(after.rest_vertices, after.tets);
  for (std::size_t t = 0; t < edit.successors.size(); ++t) {
    double sum = 0.0;
    for (const int part : edit.successors[t]) {
      sum += volumes[part];
      if (edit.successors[t].size() == 1) continue;
      EXPECT_GE(tetQuality(after.rest_vertices, after.tets.row(part)), kSettings.worst_quality);
    }
    EXPECT_NEAR(sum / old_volumes[static_cast<Eigen::Index>(t)], 1.0, 1e-3);
  }
  ASSERT_EQ(edit.vertex_origins.size(), static_cast<std::size_t>(after.rest_vertices.rows()));
  for (std::size_t v = 0; v < edit.vertex_origins.size(); ++v) {
    const Eigen::Vector3d there = positionOf(edit.vertex_origins[v], before.rest_vertices, before.tets);
    EXPECT_LT((there.transpose() - after.rest_vertices.row(static_cast<Eigen::Index>(v))).norm(), 3e-8);
    EXPECT_NEAR(edit.vertex_origins[v].barycentric.sum(), 1.0, 1e-12);
  }
}

/// Whether no piece has material on both sides of the plane, off the plane.
bool isParted(const TetTopology& after, const std::vector<bool>& on_cut, const RandomCuts::Plane& plane) {
  std::map<std::uint32_t, bool> sides;
  for (Eigen::Index t = 0; t < after.tets.rows(); ++t) {
    for (const int vertex : after.tets.row(t)) {
      if (on_cut[static_cast<std::size_t>(vertex)]) continue;
      const bool above = plane.normal.dot(after.rest_vertices.row(vertex).transpose() - plane.point) > 0.0;
      const auto [side, first] = sides.emplace(after.tet_pieces[static_cast<std::size_t>(t)], above);
      if (side->second != above) return false;
    }
  }
  return true;
}

TEST(TetCutter, HalvesTheSpongeAtItsMiddle) {
  const Body sponge{testing::sponge()};
  CutStroke stroke;
  std::string reason;
  const auto edit = cutTets(sponge.topology, sponge.cut, planePatch({0.107, 0.05, 0.0}, {1.0, 0.0, 0.0}, 1.0),
                            kSettings, &stroke, &reason);
  ASSERT_TRUE(edit.has_value()) << reason;
  expectSound(*edit, sponge.topology);
  expectDescended(*edit, sponge.topology);
  const TetTopology& after = edit->topology;
  EXPECT_EQ(after.revision, 1u);
  EXPECT_EQ(*std::max_element(after.tet_pieces.begin(), after.tet_pieces.end()), 1u);
  double cut_area = 0.0;
  for (Eigen::Index f = 0; f < after.surface.rows(); ++f) {
    const Eigen::Vector3d a = after.rest_vertices.row(after.surface(f, 0)),
                          b = after.rest_vertices.row(after.surface(f, 1)),
                          c = after.rest_vertices.row(after.surface(f, 2));
    if (!edit->cut[static_cast<std::size_t>(f)]) continue;
    cut_area += 0.5 * (b - a).cross(c - a).norm();
    EXPECT_NEAR((a + b + c).x() / 3.0, 0.107, 1e-7);
  }
  EXPECT_NEAR(cut_area, 2.0 * 0.1 * 0.03, 1e-6);
}

TEST(TetCutter, PlanesPartEveryBodyIntoSoundPieces) {
  for (const TetTopology& topology : {testing::sponge(), testing::torusVolume()}) {
    const Body body{topology};
    RandomCuts cuts(topology, 1);
    int made = 0;
    for (int k = 0; k < 200; ++k) {
      const RandomCuts::Plane plane = cuts.plane();
      CutStroke stroke;
      std::string reason;
      const auto edit = cutTets(topology, body.cut, planePatch(plane.point, plane.normal, 2.0 * cuts.size()),
                                kSettings, &stroke, &reason);
      if (!edit) continue;
      ++made;
      expectSound(*edit, topology);
      expectDescended(*edit, topology);
      EXPECT_TRUE(isParted(edit->topology, stroke.on_cut, plane)) << k;
      ASSERT_FALSE(HasFailure()) << "plane " << k;
    }
    EXPECT_GT(made, 120);
  }
}

TEST(TetCutter, SweptCutsGrowStepByStep) {
  for (const TetTopology& topology : {testing::sponge(), testing::torusVolume()}) {
    RandomCuts cuts(topology, 2);
    int made = 0;
    for (int k = 0; k < 50; ++k) {
      Body body{topology};
      CutStroke stroke;
      std::string reason;
      for (const CutPatch& patch : cuts.sweep(6)) {
        const auto edit = cutTets(body.topology, body.cut, patch, kSettings, &stroke, &reason);
        if (!edit) continue;
        ++made;
        expectSound(*edit, body.topology);
        expectDescended(*edit, body.topology);
        body = {edit->topology, edit->cut};
        ASSERT_FALSE(HasFailure()) << "sweep " << k;
      }
    }
    EXPECT_GT(made, 50);
  }
}

TEST(TetCutter, LeavesABodyThatIsMissed) {
  const Body sponge{testing::sponge()};
  CutStroke stroke;
  std::string reason;
  EXPECT_FALSE(cutTets(sponge.topology, sponge.cut, planePatch({0.0, 0.0, 1.0}, {0.0, 0.0, 1.0}, 1.0),
                       kSettings, &stroke, &reason));
  EXPECT_EQ(reason, "the cut misses the body");
}

}  // namespace
}  // namespace softbody
