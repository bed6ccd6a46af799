#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "cutting/fixtures/surface_meshes.h"
#include "cutting/fixtures/visual_sponge.h"
#include "softbody_common/rigid_fit.h"
#include "softbody_sim/cutting/binding/cuttable_surface.h"
#include "softbody_sim/dynamics/simulator.h"

namespace softbody {
namespace {

using testing::visualSponge;

constexpr double kHeight = 0.03, kPlace = 0.083;  // of the sponge, and where it is cut (x) [m]

/// A blade 150 mm long and 40 mm high in the plane x = 0; its edge is at z = 0, along y.
Points bladePolygon() {
  Points blade(4, 3);
  blade << 0.0, -0.075, 0.0, 0.0, 0.075, 0.0, 0.0, 0.075, 0.04, 0.0, -0.075, 0.04;
  return blade;
}

/// The blade's edge at a height over the sponge's underside, in the middle of its width.
Eigen::Isometry3d bladeAt(double height, double x = kPlace) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, 0.05, height));
}

/// The edge falls by `tilt` towards y = 0; shifted along y.
Eigen::Isometry3d tiltedBladeAt(double height, double tilt, double shift) {
  return Eigen::Translation3d(kPlace, 0.05 + shift, height) *
         Eigen::Isometry3d(Eigen::AngleAxisd(tilt, Eigen::Vector3d::UnitX()));
}

/// Where the tilted edge is 0.2 mm below the sponge's upper edge along x: mostly between two samples.
double heightAtTheCorner(double tilt, double shift) {
  return 0.0294 + (0.048 + shift) * std::tan(tilt) - 0.0002;
}

/// A body under a blade: simulator and surface are given the same cuts.
struct Scene {
  explicit Scene(const Eigen::Isometry3d& body_pose = testing::somePose())
      : pose(body_pose),
        simulator(testing::sponge(), Material(), {}),
        surface(visualSponge(), testing::sponge()) {
    step(true);
  }

  void step(bool reset = false) {
    TargetSet targets;
    targets.revision = simulator.topology().revision;
    targets.reset = reset;
    targets.body_pose = pose;
    simulator.step(targets, stamp += 33'000'000);
  }

  /// The blade at a place of the rest body, as a camera sees it.
  std::optional<Cut> move(const Eigen::Isometry3d& T_rest_blade) {
    step();
    const std::optional<Cut> cut =
        surface.follow(transformed(bladePolygon(), pose * T_rest_blade), simulator.state(), stamp);
    if (!cut) return cut;
    ++cuts;
    strokes.push_back(cut->stroke);
    std::string reason;
    EXPECT_TRUE(simulator.apply(*cut, &reason)) << reason;
    checkAgreement();
    return cut;
  }

  /// In steps of a millimetre, with the tremor of a tracked pose.
  void sweep(double from, double to, double tremor_m, double tremor_rad, double x = kPlace) {
    const int steps = static_cast<int>(std::ceil(std::abs(to - from) / 0.001));
    std::normal_distribution<double> normal;
    const auto shaken = [&] { return Eigen::Vector3d(normal(random), normal(random), normal(random)); };
    for (int k = 0; k <= steps; ++k) {
      Eigen::Isometry3d T = bladeAt(from + (to - from) * k / steps, x);
      const Eigen::Vector3d turn = tremor_rad / std::sqrt(3.0) * shaken();
      T.translation() += tremor_m / std::sqrt(3.0) * shaken();
      T.rotate(Eigen::AngleAxisd(turn.norm(), turn.stableNormalized()));
      move(T);
    }
  }

  void checkAgreement() const {
    EXPECT_EQ(simulator.topology().revision, surface.volume().revision);
    EXPECT_EQ(simulator.topology().rest_vertices, surface.volume().rest_vertices);
    EXPECT_EQ(simulator.topology().tets, surface.volume().tets);
    EXPECT_EQ(surface.surface().topology().revision, surface.volume().revision);
    EXPECT_EQ(testing::faultOf(surface.surface().topology(), 0.96 * 0.96 * 0.96 * 6e-4), "");
  }

  std::size_t visualPieces() const { return testing::bodyVolumes(surface.surface().topology()).size(); }
  std::size_t tetPieces() const {
    const std::vector<std::uint32_t>& bodies = simulator.topology().bodies;
    return *std::max_element(bodies.begin(), bodies.end()) + 1;
  }

  /// Lowest and highest z of the cut faces, and how far they are from the plane x = kPlace.
  Eigen::Vector3d cutBounds() const {
    const MeshTopology& mesh = surface.surface().topology();
    Eigen::Vector3d bounds(1.0, -1.0, 0.0);
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
      if (!mesh.cut[static_cast<std::size_t>(t)]) continue;
      for (const int v : mesh.triangles.row(t)) {
        bounds[0] = std::min(bounds[0], mesh.rest_vertices(v, 2));
        bounds[1] = std::max(bounds[1], mesh.rest_vertices(v, 2));
        bounds[2] = std::max(bounds[2], std::abs(mesh.rest_vertices(v, 0) - kPlace));
      }
    }
    return bounds;
  }

  Eigen::Isometry3d pose;
  Simulator simulator;
  CuttableSurface surface;
  Nanoseconds stamp = 0;
  std::mt19937 random{7};
  int cuts = 0;
  std::vector<std::uint32_t> strokes;
};

TEST(CuttableSurface, ABladeThatGoesThroughLeavesTwoPieces) {
  Scene scene;
  scene.sweep(0.05, -0.006, 0.0, 0.0);
  EXPECT_EQ(scene.visualPieces(), 2u);
  EXPECT_EQ(scene.tetPieces(), 2u);
  EXPECT_LT(scene.cutBounds()[2], 2e-4);
  EXPECT_LE(scene.cuts, 8);
  const int cuts = scene.cuts;
  scene.sweep(-0.006, 0.05, 0.0, 0.0);
  EXPECT_EQ(scene.cuts, cuts) << "the way back cut";
}

/// The edge of a blade that is tilted meets and leaves the body at corners, which can lie between two
/// samples.
TEST(CuttableSurface, ATiltedBladeThatJustGetsThroughLeavesNoCornerUncut) {
  for (const double tilt : {-0.4, -0.3, 0.1, 0.4}) {
    for (const double shift : {-0.008, -0.002, 0.006}) {
      Scene scene;
      const double last = -(0.05 + std::abs(shift)) * std::tan(std::abs(tilt)) - 0.002;
      for (double height = 0.07; height > last - 0.001; height -= 0.001) {
        scene.move(tiltedBladeAt(std::max(last, height), tilt, shift));
      }
      EXPECT_EQ(scene.visualPieces(), 2u) << "tilt " << tilt << ", shift " << shift;
    }
  }
}

TEST(CuttableSurface, ABladeLiftedWhileItTouchesACornerCutsFromThere) {
  for (const double shift : {-0.008, -0.002, 0.006}) {
    Scene scene;
    const double corner = heightAtTheCorner(0.4, shift);
    scene.move(tiltedBladeAt(corner + 0.02, 0.4, shift));
    scene.surface.lift();
    for (double height = corner; height > -0.03; height -= 0.001)
      scene.move(tiltedBladeAt(height, 0.4, shift));
    EXPECT_EQ(scene.visualPieces(), 2u) << "shift " << shift;
  }
}

/// Its way in is down; the way along the edge would make the blade's end the leading edge.
TEST(CuttableSurface, ABladeDrawnAlongItsEdgeOnACornerCutsWithItsEdge) {
  for (const double drawn : {-0.01, -0.006, 0.006, 0.01}) {
    Scene scene;
    const Eigen::Isometry3d touching = tiltedBladeAt(heightAtTheCorner(0.4, 0.0), 0.4, 0.0);
    for (int k = 20; k > 0; --k) scene.move(Eigen::Translation3d(0.0, 0.0, 0.001 * k) * touching);
    for (int k = 0; k <= 10; ++k) scene.move(touching * Eigen::Translation3d(0.0, 0.1 * k * drawn, 0.0));
    EXPECT_EQ(scene.cuts, 0);
    for (int k = 1; k < 80; ++k)
      scene.move(Eigen::Translation3d(0.0, 0.0, -0.001 * k) * touching *
                 Eigen::Translation3d(0.0, drawn, 0.0));
    EXPECT_EQ(scene.visualPieces(), 2u) << "drawn " << drawn;
  }
}

TEST(CuttableSurface, ABladeMovedToItsSideOnACornerCutsWhereItGoesIn) {
  for (const double aside : {-0.02, 0.02}) {
    Scene scene;
    const Eigen::Isometry3d touching = tiltedBladeAt(heightAtTheCorner(0.4, 0.0), 0.4, 0.0);
    for (int k = 20; k > 0; --k) scene.move(Eigen::Translation3d(aside, 0.0, 0.001 * k) * touching);
    for (int k = 20; k > 0; --k) scene.move(Eigen::Translation3d(0.05 * k * aside, 0.0, 0.0) * touching);
    for (int k = 0; k < 80; ++k) scene.move(Eigen::Translation3d(0.0, 0.0, -0.001 * k) * touching);
    EXPECT_EQ(scene.visualPieces(), 2u);
    EXPECT_LT(scene.cutBounds()[2], 1e-3);
  }
}

TEST(CuttableSurface, TremorNeitherCutsBesideNorAgain) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    Scene scene;
    scene.random.seed(seed);
    scene.sweep(0.05, -0.01, 1e-3, 0.017);
    EXPECT_EQ(scene.visualPieces(), 2u);
    EXPECT_EQ(scene.tetPieces(), 2u);
    EXPECT_LT(scene.cutBounds()[2], 6e-3);
    const int cuts = scene.cuts;
    scene.sweep(-0.01, 0.05, 1e-3, 0.017);
    EXPECT_EQ(scene.cuts, cuts) << "the way back cut";
    EXPECT_EQ(std::set<std::uint32_t>(scene.strokes.begin(), scene.strokes.end()).size(), 1u);
  }
}

TEST(CuttableSurface, ABladeWithdrawnHalfwayLeavesASlitThatItCanDeepen) {
  Scene scene;
  scene.sweep(0.05, 0.012, 3e-4, 0.005);
  scene.sweep(0.012, 0.05, 3e-4, 0.005);
  EXPECT_EQ(scene.visualPieces(), 1u);
  EXPECT_NEAR(scene.cutBounds()[0], 0.012, 2.5e-3);
  const int cuts = scene.cuts;
  scene.sweep(0.05, 0.014, 3e-4, 0.005);
  EXPECT_EQ(scene.cuts, cuts) << "the slit was cut again";
  scene.sweep(0.014, -0.006, 3e-4, 0.005);
  EXPECT_GT(scene.cuts, cuts);
  EXPECT_EQ(scene.visualPieces(), 2u);
  EXPECT_EQ(scene.tetPieces(), 2u);
  EXPECT_EQ(std::set<std::uint32_t>(scene.strokes.begin(), scene.strokes.end()).size(), 1u);
}

TEST(CuttableSurface, ABladeThatRestsPressesOrRubsCutsNothing) {
  Scene scene;
  std::normal_distribution<double> normal;
  for (int k = 0; k < 60; ++k) {  // rests on the surface
    scene.move(bladeAt(0.0294 + 1e-3 * normal(scene.random)));
  }
  for (int k = 0; k < 60; ++k) {  // its flat side, from the left
    scene.move(Eigen::Translation3d(-0.03 + 0.001 * k, 0.05, 0.005) * Eigen::Isometry3d::Identity());
  }
  EXPECT_EQ(scene.cuts, 0);
}

TEST(CuttableSurface, TwoStrokesThatCrossLeaveFourPiecesAndAreTakenBackOneByOne) {
  Scene scene;
  const TetTopology uncut = scene.surface.volume();
  scene.sweep(0.05, -0.006, 3e-4, 0.005);
  scene.sweep(-0.006, 0.05, 3e-4, 0.005);
  const Eigen::AngleAxisd turn(0.6, Eigen::Vector3d::UnitZ());
  for (int k = 0; k <= 56; ++k) scene.move(bladeAt(0.05 - 0.001 * k) * turn);
  EXPECT_EQ(scene.visualPieces(), 4u);
  EXPECT_EQ(scene.tetPieces(), 4u);
  EXPECT_EQ(std::set<std::uint32_t>(scene.strokes.begin(), scene.strokes.end()).size(), 2u);

  std::string reason;
  for (const std::size_t pieces : {2u, 1u}) {
    const Cut undo = scene.surface.edit(CutKind::kUndo);
    ASSERT_TRUE(scene.surface.apply(undo, scene.simulator.state(), &reason)) << reason;
    ASSERT_TRUE(scene.simulator.apply(undo, &reason)) << reason;
    scene.checkAgreement();
    EXPECT_EQ(scene.visualPieces(), pieces);
  }
  EXPECT_EQ(scene.simulator.topology().rest_vertices, uncut.rest_vertices);
  EXPECT_EQ(scene.simulator.topology().tets, uncut.tets);
  scene.step();
  EXPECT_FALSE(scene.surface.apply(scene.surface.edit(CutKind::kUndo), scene.simulator.state(), &reason));
  EXPECT_EQ(reason, "there is no cut to take back");
}

TEST(CuttableSurface, ABladeThatEntersAcrossASlitBeginsAnotherStroke) {
  Scene scene;
  scene.sweep(0.05, -0.006, 0.0, 0.0);
  scene.sweep(-0.006, 0.05, 0.0, 0.0);
  // Its lower end comes down in the slit, and is all of it that is in the body at first.
  const Eigen::Quaterniond turn = Eigen::AngleAxisd(-M_PI / 2.0, Eigen::Vector3d::UnitZ()) *
                                  Eigen::AngleAxisd(-0.15, Eigen::Vector3d::UnitX());
  for (int k = 0; k <= 60; ++k) scene.move(bladeAt(0.06 - 0.001 * k, kPlace - 0.0745) * turn);
  EXPECT_EQ(std::set<std::uint32_t>(scene.strokes.begin(), scene.strokes.end()).size(), 2u);
}

TEST(CuttableSurface, ABladeThatIsInTheBodyDuringAnUndoDoesNotMakeItsCutAgain) {
  Scene scene;
  scene.sweep(0.05, 0.01, 0.0, 0.0);
  const Cut undo = scene.surface.edit(CutKind::kUndo);
  std::string reason;
  ASSERT_TRUE(scene.surface.apply(undo, scene.simulator.state(), &reason)) << reason;
  ASSERT_TRUE(scene.simulator.apply(undo, &reason)) << reason;
  const int cuts = scene.cuts;
  scene.sweep(0.01, 0.009, 5e-4, 0.0);
  scene.sweep(0.009, 0.05, 0.0, 0.0);
  EXPECT_EQ(scene.cuts, cuts);
  scene.sweep(0.05, 0.01, 0.0, 0.0);
  EXPECT_GT(scene.cuts, cuts) << "it does not cut when it comes anew";
}

TEST(CuttableSurface, APreviewChangesNothingAndTellsThePieces) {
  Scene scene;
  const CutPreview preview =
      scene.surface.preview(testing::planePatch({0.06, 0.05, 0.015}, {1.0, 0.0, 0.0}, 1.0));
  EXPECT_EQ(preview.refusal, "");
  ASSERT_EQ(preview.volumes.size(), 2u);
  EXPECT_NEAR(preview.volumes[0] + preview.volumes[1], 0.96 * 0.96 * 0.96 * 6e-4, 1e-8);
  EXPECT_GT(preview.volumes[0], preview.volumes[1]);
  EXPECT_EQ(scene.surface.volume().revision, 0u);
  EXPECT_NE(scene.surface.preview(testing::planePatch({0.06, 0.05, 0.5}, {0.0, 0.0, 1.0}, 1.0)).refusal, "");
}

TEST(CuttableSurface, ABladeThatVanishesIsLifted) {
  Scene scene;
  scene.sweep(0.05, 0.015, 0.0, 0.0);
  const int cuts = scene.cuts;
  EXPECT_GT(cuts, 0);
  scene.stamp += 2'000'000'000;
  scene.sweep(0.015, 0.005, 0.0, 0.0, kPlace + 0.03);
  EXPECT_EQ(scene.cuts, cuts) << "it cut from where it vanished to where it came back";
  scene.stamp += 2'000'000'000;
  scene.sweep(0.016, -0.006, 0.0, 0.0);
  EXPECT_EQ(scene.visualPieces(), 2u) << "it came back into its slit";
  EXPECT_LT(scene.cutBounds()[2], 2e-4);
}

TEST(CuttableSurface, ABladeSeenInEverySecondFrameCuts) {
  Scene scene;
  for (int k = 0; k <= 28; ++k) {
    scene.stamp += 400'000'000;
    scene.move(bladeAt(0.05 - 0.002 * k));
  }
  EXPECT_EQ(scene.visualPieces(), 2u);
}

/// What is thrown between the edits of tets and mesh: the state that the binding has to meet is not whole.
TEST(CuttableSurface, AnEditThatFailsHalfwayChangesNothing) {
  Scene scene;
  scene.sweep(0.05, 0.012, 0.0, 0.0);
  const TetTopology tets = scene.surface.volume();
  const MeshTopology mesh = scene.surface.surface().topology();
  const Cut cut = scene.surface.separateCut(testing::planePatch({0.04, 0.05, 0.015}, {1.0, 0.1, 0.0}, 1.0));
  MeshState broken = scene.simulator.state();
  broken.confidence.pop_back();
  std::string reason;
  EXPECT_THROW(scene.surface.apply(cut, broken, &reason), std::invalid_argument);
  EXPECT_EQ(scene.surface.volume().revision, tets.revision);
  EXPECT_EQ(scene.surface.volume().tets, tets.tets);
  EXPECT_EQ(scene.surface.surface().topology().triangles, mesh.triangles);
  ASSERT_TRUE(scene.surface.apply(cut, scene.simulator.state(), &reason)) << reason;
  ASSERT_TRUE(scene.simulator.apply(cut, &reason)) << reason;
  scene.checkAgreement();
  EXPECT_EQ(scene.visualPieces(), 2u);
}

TEST(CuttableSurface, CutsThatTheSimulatorDoesNotMakeAreTakenBack) {
  Scene scene;
  scene.sweep(0.05, 0.012, 0.0, 0.0);  // a stroke of several cuts, all confirmed
  scene.surface.confirm(scene.surface.volume().revision);
  const TetTopology tets = scene.surface.volume();
  const MeshTopology mesh = scene.surface.surface().topology();
  const Points shown = scene.surface.surface().apply(scene.simulator.state()).vertices;
  MeshState state = scene.simulator.state();
  std::string reason;
  for (const double x : {0.03, 0.06}) {
    const Cut cut = scene.surface.separateCut(testing::planePatch({x, 0.05, 0.015}, {1.0, 0.1, 0.0}, 1.0));
    state.revision = scene.surface.volume().revision;
    state.vertices = scene.surface.volume().rest_vertices;
    state.confidence.assign(static_cast<std::size_t>(state.vertices.rows()), 1.0f);
    ASSERT_TRUE(scene.surface.apply(cut, state, &reason)) << reason;
  }
  EXPECT_FALSE(scene.surface.rollBack(tets.revision - 1)) << "that is confirmed";
  EXPECT_FALSE(scene.surface.rollBack(tets.revision + 3));
  EXPECT_EQ(scene.surface.volume().revision, tets.revision + 2);
  ASSERT_TRUE(scene.surface.rollBack(tets.revision));
  scene.checkAgreement();
  EXPECT_EQ(scene.surface.volume().rest_vertices, tets.rest_vertices);
  EXPECT_EQ(scene.surface.surface().topology().rest_vertices, mesh.rest_vertices);
  EXPECT_EQ(scene.surface.surface().apply(scene.simulator.state()).vertices, shown);
  scene.sweep(0.012, 0.05, 0.0, 0.0);
  scene.sweep(0.05, -0.006, 0.0, 0.0);
  EXPECT_EQ(scene.visualPieces(), 2u) << "nothing can be cut after a cut was taken back";
}

}  // namespace
}  // namespace softbody
