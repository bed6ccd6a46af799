#include <gtest/gtest.h>

#include <set>

#include "cutting/fixtures/blade_scene.h"

namespace softbody {
namespace {

using testing::bladeAt;
using testing::heightAtTheCorner;
using testing::kPlace;
using testing::Scene;
using testing::tiltedBladeAt;

TEST(BladeCuts, ABladeThatGoesThroughLeavesTwoPieces) {
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

/// The edge of a tilted blade enters and leaves the body at corners, which can lie between two samples.
TEST(BladeCuts, ATiltedBladeThatJustGetsThroughLeavesNoCornerUncut) {
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

TEST(BladeCuts, ABladeLiftedWhileItTouchesACornerCutsFromThere) {
  for (const double shift : {-0.008, -0.002, 0.006}) {
    Scene scene;
    const double corner = heightAtTheCorner(0.4, shift);
    scene.move(tiltedBladeAt(corner + 0.02, 0.4, shift));
    scene.stamp += 1'000'000'000;  // lifted
    for (double height = corner; height > -0.03; height -= 0.001)
      scene.move(tiltedBladeAt(height, 0.4, shift));
    EXPECT_EQ(scene.visualPieces(), 2u) << "shift " << shift;
  }
}

/// The blade enters downward. Motion along the edge must not make the end of the blade the leading edge.
TEST(BladeCuts, ABladeDrawnAlongItsEdgeOnACornerCutsWithItsEdge) {
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

TEST(BladeCuts, ABladeMovedToItsSideOnACornerCutsWhereItGoesIn) {
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

TEST(BladeCuts, TremorNeitherCutsBesideNorAgain) {
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

TEST(BladeCuts, ABladeWithdrawnHalfwayLeavesASlitThatItCanDeepen) {
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

TEST(BladeCuts, ABladeThatRestsPressesOrRubsCutsNothing) {
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

TEST(BladeCuts, ABladeThatEntersAcrossASlitBeginsAnotherStroke) {
  Scene scene;
  scene.sweep(0.05, -0.006, 0.0, 0.0);
  scene.sweep(-0.006, 0.05, 0.0, 0.0);
  // At first only the lower end of the blade is in the body, inside the slit.
  const Eigen::Quaterniond turn = Eigen::AngleAxisd(-M_PI / 2.0, Eigen::Vector3d::UnitZ()) *
                                  Eigen::AngleAxisd(-0.15, Eigen::Vector3d::UnitX());
  for (int k = 0; k <= 60; ++k) scene.move(bladeAt(0.06 - 0.001 * k, kPlace - 0.0745) * turn);
  EXPECT_EQ(std::set<std::uint32_t>(scene.strokes.begin(), scene.strokes.end()).size(), 2u);
}

TEST(BladeCuts, ABladeThatVanishesIsLifted) {
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

TEST(BladeCuts, ABladeSeenInEverySecondFrameCuts) {
  Scene scene;
  for (int k = 0; k <= 28; ++k) {
    scene.stamp += 400'000'000;
    scene.move(bladeAt(0.05 - 0.002 * k));
  }
  EXPECT_EQ(scene.visualPieces(), 2u);
}

}  // namespace
}  // namespace softbody
