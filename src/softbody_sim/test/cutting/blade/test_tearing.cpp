#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>

#include "cutting/blade/tearing.h"
#include "cutting/fixtures/surface_meshes.h"
#include "cutting/fixtures/visual_sponge.h"
#include "softbody_sim/cutting/binding/cuttable_surface.h"
#include "softbody_sim/dynamics/simulator.h"

namespace softbody {
namespace {

constexpr double kVisualVolume = 0.96 * 0.96 * 0.96 * 6e-4;  // [m^3]

/// Maps rest positions to deformed positions.
using Deformation = std::function<Eigen::RowVector3d(const Eigen::RowVector3d&)>;

/// Stretches the sponge from x = 80 to 120 mm by `factor`, at the points selected by `where`.
Deformation stretchedMiddle(double factor, double only_below_y = 1.0) {
  return [=](const Eigen::RowVector3d& rest) -> Eigen::RowVector3d {
    const double share = rest.y() < only_below_y ? 1.0 : 0.0;
    return rest +
           Eigen::RowVector3d((factor - 1.0) * share * std::clamp(rest.x() - 0.08, 0.0, 0.04), 0.0, 0.0);
  };
}

/// A body in a sequence of deformed states.
struct Scene {
  explicit Scene(double tear_strain, const TetTopology& volume = testing::sponge(),
                 const MeshTopology& visual = testing::visualSponge())
      : surface(visual, volume, config(tear_strain)) {}

  static CuttingConfig config(double tear_strain) {
    CuttingConfig config;
    config.tear_strain = tear_strain;
    return config;
  }
  MeshState stateOf(const Deformation& deformation) const {
    MeshState state;
    state.revision = surface.volume().revision;
    state.vertices = surface.volume().rest_vertices;
    for (auto&& row : state.vertices.rowwise()) row = deformation(row);
    state.confidence.assign(static_cast<std::size_t>(state.vertices.rows()), 1.0f);
    return state;
  }
  /// @return the number of states until the body tears; 0: it does not tear.
  int statesUntilTear(const Deformation& deformation, int most = 20) {
    for (int k = 1; k <= most; ++k) {
      last = surface.tear(stateOf(deformation));
      if (last) return k;
    }
    return 0;
  }
  std::size_t pieces() const { return testing::pieceVolumes(surface.surface().topology()).size(); }
  void expectSound() const {
    EXPECT_EQ(testing::faultOf(surface.surface().topology(), kVisualVolume), "");
    const TetTopology& volume = surface.volume();
    EXPECT_NEAR(tetVolumes(volume.rest_vertices, volume.tets).sum() / 6e-4, 1.0, 1e-5);
    EXPECT_GT(tetVolumes(volume.rest_vertices, volume.tets).minCoeff(), 0.0);
  }

  CuttableSurface surface;
  std::optional<Cut> last;
};

TEST(Tearing, TheStretchDecidesNotTheTurn) {
  const TetTopology sponge = testing::sponge();
  Points x = sponge.rest_vertices;
  x.col(0) *= 1.5;
  x.col(1) *= 0.8;
  const PrincipalStretch stretch = principalStretch(sponge, transformed(x, testing::somePose()), 17);
  EXPECT_NEAR(stretch.stretch, 1.5, 1e-9);
  EXPECT_NEAR(std::abs(stretch.direction.x()), 1.0, 1e-9);
}

TEST(Tearing, AStretchedBarTearsIntoTwoClosedPieces) {
  Scene scene(0.4);
  EXPECT_EQ(scene.statesUntilTear(stretchedMiddle(1.5)), 5);
  EXPECT_EQ(scene.pieces(), 2u);
  EXPECT_EQ(
      *std::max_element(scene.surface.volume().tet_pieces.begin(), scene.surface.volume().tet_pieces.end()),
      1u);
  scene.expectSound();
  const MeshTopology& mesh = scene.surface.surface().topology();
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    if (!mesh.cut[static_cast<std::size_t>(t)]) continue;
    for (const int v : mesh.triangles.row(t)) {
      EXPECT_GT(mesh.rest_vertices(v, 0), 0.08);
      EXPECT_LT(mesh.rest_vertices(v, 0), 0.12);
    }
  }
}

TEST(Tearing, TheSimulatorMakesTheSameTear) {
  Scene scene(0.4);
  Simulator simulator(testing::sponge(), Material(), {});
  ASSERT_GT(scene.statesUntilTear(stretchedMiddle(1.5)), 0);
  std::string reason;
  ASSERT_TRUE(simulator.apply(*scene.last, &reason)) << reason;
  EXPECT_EQ(simulator.topology().tets, scene.surface.volume().tets);
  EXPECT_EQ(simulator.topology().rest_vertices, scene.surface.volume().rest_vertices);
}

TEST(Tearing, BelowTheLimitOrWithoutOneNothingTears) {
  EXPECT_EQ(Scene(0.4).statesUntilTear(stretchedMiddle(1.35)), 0);
  EXPECT_EQ(Scene(0.0).statesUntilTear(stretchedMiddle(3.0)), 0);
  EXPECT_EQ(Scene(0.01).statesUntilTear([](const Eigen::RowVector3d& rest) -> Eigen::RowVector3d {
    return (testing::somePose() * rest.transpose()).transpose();
  }),
            0);
}

TEST(Tearing, AStateThatJerksDoesNotTear) {
  Scene scene(0.4);
  for (int k = 0; k < 30; ++k)
    EXPECT_EQ(scene.statesUntilTear(stretchedMiddle(k % 2 == 0 ? 1.6 : 1.1), k % 2 == 0 ? 4 : 1), 0);
}

TEST(Tearing, ATearEndsWhereTheStretchDoes) {
  Scene scene(0.4);
  EXPECT_EQ(scene.statesUntilTear(stretchedMiddle(1.6, 0.05)), 5);
  EXPECT_EQ(scene.pieces(), 1u);
  scene.expectSound();
  EXPECT_EQ(scene.statesUntilTear(stretchedMiddle(1.6)), 5) << "it goes on";
  scene.expectSound();
}

/// A crack runs through material that would not have torn by itself.
TEST(Tearing, ATearRunsThroughLessStretchedMaterial) {
  const Deformation uneven = [](const Eigen::RowVector3d& rest) -> Eigen::RowVector3d {
    const double strain = 0.5 - 1.5 * rest.y();  // 0.5 to 0.35
    return rest + Eigen::RowVector3d(strain * std::clamp(rest.x() - 0.05, 0.0, 0.1), 0.0, 0.0);
  };
  Scene scene(0.4);
  EXPECT_EQ(scene.statesUntilTear(uneven), 5);
  EXPECT_EQ(scene.pieces(), 2u);
  scene.expectSound();
}

TEST(Tearing, ATearCrossesASlit) {
  Scene scene(0.4);
  CutPatch slit{Points(4, 3), Triangles(2, 3)};
  slit.vertices << -0.1, 0.047, -0.1, 0.15, 0.047, -0.1, 0.15, 0.047, 0.1, -0.1, 0.047, 0.1;
  slit.triangles << 0, 1, 2, 0, 2, 3;
  std::string reason;
  const Deformation none = [](const Eigen::RowVector3d& rest) -> Eigen::RowVector3d { return rest; };
  ASSERT_TRUE(scene.surface.apply(scene.surface.separateCut(slit), scene.stateOf(none), &reason)) << reason;
  EXPECT_EQ(scene.pieces(), 1u);
  EXPECT_EQ(scene.statesUntilTear(stretchedMiddle(1.5)), 5);
  EXPECT_EQ(scene.pieces(), 3u);
  scene.expectSound();
}

/// A bar of 150 cells, stretched in one cell, at its end or further inside.
TEST(Tearing, NoCrumbIsTorn) {
  const TetTopology bar = testing::boxTopology({150, 1, 1}, {0.3, 0.02, 0.02});
  const MeshTopology mesh = testing::meshTopology({bar.rest_vertices, bar.surface});
  const auto stretchedFrom = [](double x) {
    return [=](const Eigen::RowVector3d& rest) -> Eigen::RowVector3d {
      return rest + Eigen::RowVector3d(0.7 * std::clamp(rest.x() - x, 0.0, 0.002), 0.0, 0.0);
    };
  };
  Scene scene(0.4, bar, mesh);
  EXPECT_EQ(scene.statesUntilTear(stretchedFrom(0.298)), 0);
  EXPECT_EQ(scene.surface.volume().revision, 0u);
  EXPECT_EQ(scene.statesUntilTear(stretchedFrom(0.29)), 5);
  EXPECT_EQ(scene.pieces(), 2u);
}

/// Patches that do not become cuts.
TEST(Tearing, ATetAsksOnceUntilItHasBeenWithinTheLimit) {
  Scene scene(0.4);
  const MeshState pulled = scene.stateOf(stretchedMiddle(1.5)), slack = scene.stateOf(stretchedMiddle(1.1));
  const TetTopology& volume = scene.surface.volume();
  TearWatch watch(0.4);
  int beyond = 0, asked = 0;
  for (int t = 0; t < volume.tets.rows(); ++t)
    beyond += principalStretch(volume, pulled.vertices, t).stretch > 1.4 ? 1 : 0;
  for (int k = 0; k < 5 * beyond; ++k) asked += watch.follow(volume, pulled.vertices) ? 1 : 0;
  EXPECT_GT(asked, 0);
  EXPECT_LE(asked, beyond);
  for (int k = 0; k < 50; ++k) EXPECT_FALSE(watch.follow(volume, pulled.vertices));
  EXPECT_FALSE(watch.follow(volume, slack.vertices));
  for (int k = 1; k <= 5; ++k) EXPECT_EQ(watch.follow(volume, pulled.vertices).has_value(), k == 5);
}

TEST(Tearing, ATetAsksAgainOnceItIsStretchedATenthFurther) {
  Scene scene(0.4);
  TearWatch watch(0.4);
  const auto asks = [&](double factor) {
    int asked = 0;
    const MeshState state = scene.stateOf(stretchedMiddle(factor));
    for (int k = 0; k < 5 * scene.surface.volume().tets.rows(); ++k)
      asked += watch.follow(scene.surface.volume(), state.vertices) ? 1 : 0;
    return asked;
  };
  const int first = asks(1.5);
  EXPECT_GT(first, 0);
  EXPECT_EQ(asks(1.64), 0);
  EXPECT_EQ(asks(1.66), first);
  EXPECT_EQ(asks(1.82), 0);
  EXPECT_EQ(asks(1.83), first);
}

/// Repeatedly torn bodies stay valid.
TEST(Tearing, RandomStretchLeavesSoundPieces) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  int tears = 0;
  for (int k = 0; k < 12; ++k) {
    Scene scene(0.3);
    for (int step = 0; step < 3; ++step) {
      const Eigen::RowVector3d way(uniform(random), uniform(random), 0.3 * uniform(random));
      const Eigen::RowVector3d direction = way.normalized();
      const double place = 0.06 * uniform(random), width = 0.03 + 0.01 * uniform(random);
      const auto pulled = [=](const Eigen::RowVector3d& rest) -> Eigen::RowVector3d {
        const double along = direction.dot(rest - Eigen::RowVector3d(0.1, 0.05, 0.015)) - place;
        return rest + 0.7 * std::clamp(along, 0.0, width) * direction;
      };
      tears += scene.statesUntilTear(pulled) > 0;
      scene.expectSound();
    }
  }
  EXPECT_GT(tears, 12);
}

}  // namespace
}  // namespace softbody
