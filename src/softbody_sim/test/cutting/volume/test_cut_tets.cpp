#include <gtest/gtest.h>

#include "cutting/fixtures/cut_bodies.h"
#include "cutting/fixtures/same_topology.h"
#include "cutting/volume/manifold.h"

namespace softbody {
namespace {

using testing::CutTets;
using testing::expectSame;
using testing::RandomCuts;

/// Positions of a bent and rotated body.
Points deformed(const Points& rest) {
  Points x = rest;
  for (Eigen::Index v = 0; v < x.rows(); ++v) {
    x.row(v) << rest(v, 0) + 0.3 * rest(v, 1), rest(v, 1) + 2.0 * rest(v, 0) * rest(v, 0), rest(v, 2) + 0.4;
  }
  return x;
}

/// Each place of the earlier topology keeps its position through the edit, at rest and deformed.
void expectPlacesKept(const TetEdit& edit, const TetTopology& before) {
  const Points x = deformed(before.rest_vertices);
  const Points x_after = applyBinding(edit.vertex_origins, x, before.tets);
  std::mt19937 random(3);
  std::exponential_distribution<double> share;
  for (int t = 0; t < static_cast<int>(before.tets.rows()); ++t) {
    MaterialPoint place{t, Eigen::Vector4d::NullaryExpr([&] { return share(random); })};
    place.barycentric /= place.barycentric.sum();
    const MaterialPoint after = edit.placeAfter(place, before);
    EXPECT_GT(after.barycentric.minCoeff(), -1e-4);
    EXPECT_LT((positionOf(after, edit.topology.rest_vertices, edit.topology.tets) -
               positionOf(place, before.rest_vertices, before.tets))
                  .norm(),
              1e-7);
    EXPECT_LT((positionOf(after, x_after, edit.topology.tets) - positionOf(place, x, before.tets)).norm(),
              1e-6);
  }
}

TEST(CutTets, FiveCutsAndBackAndForthAgain) {
  for (const TetTopology& body : {testing::sponge(), testing::torusVolume()}) {
    CutTets history(body);
    RandomCuts cuts(body, 5);
    std::vector<TetTopology> versions{body};
    for (std::uint32_t stroke = 1; versions.size() <= 5; ++stroke) {
      const TetTopology before = history.topology();
      const auto edit = history.cut(cuts.planeCut(), stroke);
      if (!edit) continue;
      expectPlacesKept(*edit, before);
      EXPECT_EQ(nonManifoldVertices(history.topology().surface), std::vector<int>());
      versions.push_back(history.topology());
    }
    std::uint32_t revision = history.topology().revision;
    for (std::size_t v = 5; v-- > 0;) {
      const TetTopology before = history.topology();
      const auto edit = history.apply(CutKind::kUndo);
      ASSERT_TRUE(edit);
      expectSame(history.topology(), versions[v]);
      EXPECT_EQ(history.topology().revision, ++revision);
      EXPECT_EQ(edit->topology.revision, revision);
    }
    EXPECT_FALSE(history.apply(CutKind::kUndo));
    for (std::size_t v = 1; v <= 5; ++v) {
      const TetTopology before = history.topology();
      const auto edit = history.apply(CutKind::kRedo);
      ASSERT_TRUE(edit);
      expectSame(history.topology(), versions[v]);
      EXPECT_EQ(history.topology().revision, ++revision);
      expectPlacesKept(*edit, before);
    }
    EXPECT_FALSE(history.apply(CutKind::kRedo));
    ASSERT_TRUE(history.apply(CutKind::kReset));
    expectSame(history.topology(), body);
    ASSERT_TRUE(history.apply(CutKind::kRedo));
    expectSame(history.topology(), versions[1]);
  }
}

TEST(CutTets, AStrokeOfManyStepsIsOneUndoStep) {
  const TetTopology sponge = testing::sponge();
  CutTets history(sponge);
  std::size_t edits = 0;
  for (int step = 0; step < 8; ++step) {
    Points before(2, 3), now(2, 3);
    before << 0.11, 0.02 * step - 0.01, -0.1, 0.11, 0.02 * step - 0.01, 0.1;
    now << 0.11, 0.02 * step + 0.01, -0.1, 0.11, 0.02 * step + 0.01, 0.1;
    edits += history.cut(ruledPatch(before, now), 7) ? 1 : 0;
  }
  EXPECT_GT(edits, 3u);
  EXPECT_EQ(history.topology().tet_pieces.back(), 1u);
  const TetTopology halves = history.topology();
  ASSERT_TRUE(history.apply(CutKind::kUndo));
  expectSame(history.topology(), sponge);
  const auto again = history.apply(CutKind::kRedo);
  ASSERT_TRUE(again);
  expectSame(history.topology(), halves);
  expectPlacesKept(*again, sponge);
}

TEST(CutTets, ABladeDrawnBackThroughItsSlitCutsNothing) {
  const TetTopology sponge = testing::sponge();
  CutTets history(sponge);
  Points edges[5];
  for (int k = 0; k < 5; ++k) {
    edges[k].resize(2, 3);
    edges[k] << 0.11, 0.015 * k - 0.005, -0.1, 0.11, 0.015 * k - 0.005, 0.1;
  }
  for (int k = 0; k < 4; ++k) history.cut(ruledPatch(edges[k], edges[k + 1]), 1);
  const TetTopology slit = history.topology();
  for (int k = 4; k > 0; --k) EXPECT_FALSE(history.cut(ruledPatch(edges[k], edges[k - 1]), 1)) << k;
  expectSame(history.topology(), slit);
}

TEST(CutTets, RefusesAPatchThatIsNone) {
  CutTets history(testing::sponge());
  CutPatch patch = testing::planePatch({0.1, 0.05, 0.01}, {1.0, 0.0, 0.0}, 1.0);
  patch.triangles(0, 1) = 17;
  EXPECT_THROW(history.cut(patch, 1), std::invalid_argument);
  patch.triangles(0, 1) = 1;
  patch.vertices(0, 0) = std::nan("");
  EXPECT_THROW(history.cut(patch, 1), std::invalid_argument);
}

}  // namespace
}  // namespace softbody
