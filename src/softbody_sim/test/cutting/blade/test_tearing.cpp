#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>

#include "cutting/blade/tearing.h"
#include "cutting/blade/tet_stretch.h"
#include "cutting/fixtures/surface_meshes.h"
#include "cutting/fixtures/visual_sponge.h"
#include "softbody_sim/cutting/binding/cuttable_body.h"

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
  /// @param deviation standard deviation of the vertices [m]; 0: not estimated.
  MeshState stateOf(const Deformation& deformation, float deviation = 0.0f) const {
    MeshState state;
    state.revision = surface.volume().revision;
    state.vertices = surface.volume().rest_vertices;
    for (auto&& row : state.vertices.rowwise()) row = deformation(row);
    state.confidence.assign(static_cast<std::size_t>(state.vertices.rows()), 1.0f);
    if (deviation > 0.0f) state.standard_deviation.assign(state.confidence.size(), deviation);
    return state;
  }
  bool tears(const Deformation& deformation, float deviation = 0.0f) {
    return surface.tear(stateOf(deformation, deviation)).has_value();
  }
  std::size_t pieces() const { return testing::pieceVolumes(surface.surface().topology()).size(); }
  void expectSound() const {
    EXPECT_EQ(testing::faultOf(surface.surface().topology(), kVisualVolume), "");
    const TetTopology& volume = surface.volume();
    EXPECT_NEAR(tetVolumes(volume.rest_vertices, volume.tets).sum() / 6e-4, 1.0, 1e-5);
    EXPECT_GT(tetVolumes(volume.rest_vertices, volume.tets).minCoeff(), 0.0);
  }

  CuttableBody surface;
};

TEST(Tearing, TheStretchDecidesNotTheTurn) {
  const TetTopology sponge = testing::sponge();
  MeshState state;
  state.vertices = sponge.rest_vertices;
  state.vertices.col(0) *= 1.5;
  state.vertices.col(1) *= 0.8;
  state.vertices = transformed(state.vertices, testing::somePose());
  for (const TetStretch& stretch : tetStretches(sponge, state)) {
    EXPECT_NEAR(stretch.stretch, 1.5, 1e-9);
    EXPECT_NEAR(std::abs(stretch.direction.x()), 1.0, 1e-9);
    EXPECT_EQ(stretch.deviation, 0.0);
  }
}

/// Noise of the vertices, with a seed.
TEST(Tearing, TheDeviationIsThatOfTheStretchInManyTrials) {
  const TetTopology sponge = testing::sponge();
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 1e-4);
  MeshState state;
  state.vertices = sponge.rest_vertices;
  state.vertices.col(0) *= 1.5;
  state.standard_deviation.assign(static_cast<std::size_t>(state.vertices.rows()), std::sqrt(3e-8f));
  state.confidence.assign(state.standard_deviation.size(), 1.0f);
  const TetStretch expected = tetStretches(sponge, state)[17];
  double sum = 0.0;
  constexpr int kTrials = 2000;
  for (int k = 0; k < kTrials; ++k) {
    MeshState noisy = state;
    for (double& coordinate : noisy.vertices.reshaped()) coordinate += noise(random);
    sum += std::pow(tetStretches(sponge, noisy)[17].stretch - 1.5, 2);
  }
  EXPECT_NEAR(std::sqrt(sum / kTrials) / expected.deviation, 1.0, 0.06);
}

TEST(Tearing, AStretchedBarTearsIntoTwoClosedPieces) {
  Scene scene(0.4);
  EXPECT_TRUE(scene.tears(stretchedMiddle(1.5)));
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

TEST(Tearing, BelowTheLimitOrWithoutOneNothingTears) {
  EXPECT_FALSE(Scene(0.4).tears(stretchedMiddle(1.35)));
  EXPECT_FALSE(Scene(0.0).tears(stretchedMiddle(3.0)));
  EXPECT_FALSE(Scene(0.01).tears([](const Eigen::RowVector3d& rest) -> Eigen::RowVector3d {
    return (testing::somePose() * rest.transpose()).transpose();
  }));
}

/// Five standard deviations of the strain: 1 mm of the vertices are some 5 % in tets of 20 mm.
TEST(Tearing, AStretchWithinItsDeviationDoesNotTear) {
  Scene scene(0.4);
  EXPECT_FALSE(scene.tears(stretchedMiddle(1.5), 4e-3f));
  EXPECT_FALSE(scene.tears(stretchedMiddle(2.0), 0.1f)) << "nothing is known of the body";
  EXPECT_TRUE(scene.tears(stretchedMiddle(1.5), 1e-4f));
}

TEST(Tearing, ATearEndsWhereTheStretchDoes) {
  Scene scene(0.4);
  EXPECT_TRUE(scene.tears(stretchedMiddle(1.6, 0.05)));
  EXPECT_EQ(scene.pieces(), 1u);
  scene.expectSound();
  EXPECT_TRUE(scene.tears(stretchedMiddle(1.6))) << "it goes on";
  scene.expectSound();
}

/// A crack runs through material that would not have torn by itself.
TEST(Tearing, ATearRunsThroughLessStretchedMaterial) {
  const Deformation uneven = [](const Eigen::RowVector3d& rest) -> Eigen::RowVector3d {
    const double strain = 0.5 - 1.5 * rest.y();  // 0.5 to 0.35
    return rest + Eigen::RowVector3d(strain * std::clamp(rest.x() - 0.05, 0.0, 0.1), 0.0, 0.0);
  };
  Scene scene(0.4);
  EXPECT_TRUE(scene.tears(uneven));
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
  EXPECT_TRUE(scene.tears(stretchedMiddle(1.5)));
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
  EXPECT_FALSE(scene.tears(stretchedFrom(0.298)));
  EXPECT_EQ(scene.surface.volume().revision, 0u);
  EXPECT_TRUE(scene.tears(stretchedFrom(0.29)));
  EXPECT_EQ(scene.pieces(), 2u);
}

/// Patches that do not become cuts.
TEST(Tearing, ATetAsksOnceUntilItIsWithinTheLimitOrATenthFurther) {
  Scene scene(0.4);
  const TetTopology& volume = scene.surface.volume();
  TearWatch watch(0.4);
  const auto asks = [&](double factor) {
    int asked = 0;
    for (int k = 0; k < volume.tets.rows(); ++k)
      asked += watch.follow(volume, scene.stateOf(stretchedMiddle(factor)), {}) ? 1 : 0;
    return asked;
  };
  const int first = asks(1.5);
  EXPECT_GT(first, 0);
  EXPECT_EQ(asks(1.64), 0);
  EXPECT_EQ(asks(1.66), first);
  EXPECT_EQ(asks(1.5), 0);
  EXPECT_EQ(asks(1.1), 0);
  EXPECT_EQ(asks(1.5), first);
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
      tears += scene.tears(pulled) ? 1 : 0;
      scene.expectSound();
    }
  }
  EXPECT_GT(tears, 12);
}

}  // namespace
}  // namespace softbody
