#include <gtest/gtest.h>

#include <random>

#include "depth/outline_associations.h"
#include "fixtures/synthetic_scene.h"
#include "softbody_common/rigid_fit.h"
#include "softbody_common/tet_geometry.h"

namespace softbody {
namespace {

constexpr double kBoxDepth = 0.5;                  // [m] of the box
constexpr double kPixel = kBoxDepth / 615.0;       // [m] that one pixel shows there
constexpr double kDeadZone = 2.0;                  // [px]
constexpr double kQuantization = 1.1;              // [px] of an end of the body, along a normal
const Eigen::Vector3d kFlat(0.0, 0.0, kBoxDepth);  // the box as seen from above

/// Of the box from above, where the outline turns.
bool isAtCorner(const Association& a) { return std::abs(a.predicted.y()) > 0.044; }

class OutlineAssociationsTest : public ::testing::Test {
 protected:
  OutlineAssociationsTest() : surface_(box_.volume, box_.surface) { show(kFlat); }

  Points boxAt(const Eigen::Vector3d& position) const {
    return transformed(box_.volume.rest_vertices, Eigen::Isometry3d(Eigen::Translation3d(position)));
  }
  void show(const Eigen::Vector3d& position) { frame_ = renderFrame(box_, boxAt(position), 1); }

  std::vector<Association> associate(const Points& predicted,
                                     const Eigen::Isometry3d& motion = Eigen::Isometry3d::Identity(),
                                     double weight = 1.0) {
    surface_.render(frame_.camera, predicted);
    OutlineAssociator outline({weight}, meanEdgeLength(box_.volume.rest_vertices, box_.volume.tets));
    outline.sample(surface_);
    return outline.associate(frame_, surface_.image(), RigidMotions(surface_.pieceCount(), motion), colors_);
  }
  std::vector<Association> associateShifted(double pixels) {
    return associate(boxAt(kFlat + Eigen::Vector3d(pixels * kPixel, 0.0, 0.0)));
  }

  BoxBody box_ = makeBox();
  PredictedSurface surface_;
  RgbdFrame frame_;
  ColorModel colors_;
};

TEST_F(OutlineAssociationsTest, AreSilentWhereThePredictionIsAboutRight) {
  for (const double pixels : {0.0, 0.3, -0.4, 0.7, -0.8}) EXPECT_TRUE(associateShifted(pixels).empty());
  EXPECT_TRUE(associateShifted(10.0).size() > 20u);
}

/// The near rim is pulled back, the far one out, each by what the shift exceeds the dead zone.
TEST_F(OutlineAssociationsTest, PullAShiftedOutlineBack) {
  for (const double pixels : {4.0, 8.0, -6.0, -9.0}) {
    int left = 0, right = 0;
    for (const Association& a : associateShifted(pixels)) {
      if (isAtCorner(a)) continue;
      const Eigen::Vector3d pull = a.residual() * a.normal;
      EXPECT_LT(pull.x() * pixels, 0.0);
      // The rim is nearer than the middle of the box.
      const double pulled = std::abs(pull.x()) * 615.0 / a.predicted.z();
      EXPECT_NEAR(pulled, std::abs(pixels) * kBoxDepth / a.predicted.z() - kDeadZone, kQuantization);
      ++(a.predicted.x() < 0.0 ? left : right);
    }
    EXPECT_GT(left, 5);
    EXPECT_GT(right, 5);
  }
}

TEST_F(OutlineAssociationsTest, OnlyTheDistanceAcrossTheOutlineCounts) {
  for (const Association& a : associateShifted(8.0)) {
    if (isAtCorner(a)) continue;
    EXPECT_NEAR(a.normal.y(), 0.0, 0.05) << "along the steep outline nothing counts";
    EXPECT_NEAR(a.normal.norm(), 1.0, 1e-9);
    EXPECT_NEAR(a.normal.dot(a.measured.normalized()), 0.0, 1e-9) << "along its ray nothing counts";
    EXPECT_LT((positionOf(a.place, surface_.volumeVertices(), box_.volume.tets) - a.predicted).norm(), 1e-6);
  }
}

/// Turned, shifted bodies find back to where nothing is said any more.
TEST_F(OutlineAssociationsTest, LeadBackToTheBody) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> shift(-10.0 * kPixel, 10.0 * kPixel), angle(-0.05, 0.05);
  const Points truth = transformed(box_.volume.rest_vertices, boxPose());
  frame_ = renderFrame(box_, truth, 1);
  for (int i = 0; i < 10; ++i) {
    const Eigen::Isometry3d error = Eigen::Translation3d(shift(random), shift(random), kBoxDepth) *
                                    Eigen::AngleAxisd(angle(random), Eigen::Vector3d::UnitZ()) *
                                    Eigen::Translation3d(0.0, 0.0, -kBoxDepth);
    Points predicted = transformed(truth, error);
    for (int step = 0; step < 20; ++step)
      predicted = transformed(predicted, rigidStep(refsTo(associate(predicted))));
    const Points offsets = predicted - truth;
    EXPECT_LT(offsets.leftCols<2>().rowwise().norm().mean(), (kDeadZone + kQuantization) * kPixel);
  }
}

TEST_F(OutlineAssociationsTest, MoveWithTheirSamples) {
  const Eigen::Isometry3d error(Eigen::Translation3d(12.0 * kPixel, -7.0 * kPixel, 0.0));
  const Points predicted = transformed(boxAt(kFlat), error);
  EXPECT_FALSE(associate(predicted).empty());
  EXPECT_TRUE(associate(predicted, error.inverse()).empty());
}

/// What stands before the body hides where it ends, before and beside its outline.
TEST_F(OutlineAssociationsTest, OccludersSayNothing) {
  const cv::Rect over_right_rim(400, 0, 240, 480);
  frame_.depth(over_right_rim) = 0.3f;
  for (const double pixels : {10.0, -10.0}) {
    const std::vector<Association> found = associateShifted(pixels);
    EXPECT_FALSE(found.empty());
    for (const Association& a : found) EXPECT_LT(a.predicted.x(), 0.0);
  }
}

TEST_F(OutlineAssociationsTest, MissingDepthSaysNothing) {
  frame_.depth(cv::Rect(400, 0, 240, 480)) = 0.0f;
  for (const double pixels : {10.0, -10.0}) {
    const auto found = associateShifted(pixels);
    EXPECT_FALSE(found.empty()) << "the other side is measured";
    for (const Association& a : found) EXPECT_LT(a.predicted.x(), 0.0);
  }
}

/// A thing that the body touches goes on from it without a step.
TEST_F(OutlineAssociationsTest, WhatTheBodyTouchesSaysNothing) {
  cv::Mat1f& depth = frame_.depth;
  const float top = depth(240, 320);
  depth.setTo(top, depth > 1.0f);
  for (const double pixels : {10.0, -10.0}) EXPECT_TRUE(associateShifted(pixels).empty());
}

/// A hand at the body's own depth that ends before the background.
TEST_F(OutlineAssociationsTest, ForeignColorsDoNotPull) {
  cv::Mat1b body(frame_.depth < 1.0f);
  colors_.learn(frame_.color, body);
  ASSERT_TRUE(colors_.learned());
  const float top = frame_.depth(240, 320);
  const cv::Rect hand(380, 200, 75, 80);
  cv::Mat1b on_hand(body.size(), uchar(0));
  on_hand(hand).setTo(255, ~body(hand));
  frame_.depth.setTo(top, on_hand);
  frame_.color.setTo(frame_.color(240, 320), on_hand);
  EXPECT_FALSE(associateShifted(0.0).empty());
  frame_.color.setTo(cv::Vec3b(250, 20, 20), on_hand);
  EXPECT_TRUE(associateShifted(0.0).empty());
}

TEST_F(OutlineAssociationsTest, TheImagesBorderIsNoOutline) {
  const Eigen::Vector3d half_out = kFlat + Eigen::Vector3d(0.2, 0.0, 0.0);
  const double left_rim = 0.1;
  show(half_out);
  for (const double pixels : {6.0, -6.0}) {
    for (const Association& a : associate(boxAt(half_out + Eigen::Vector3d(pixels * kPixel, 0.0, 0.0))))
      EXPECT_NEAR(a.predicted.x(), left_rim, 0.02);
  }
  EXPECT_FALSE(associate(boxAt(half_out - Eigen::Vector3d(6.0 * kPixel, 0.0, 0.0))).empty());
}

TEST_F(OutlineAssociationsTest, TellThePieces) {
  box_ = cutBox(box_);
  surface_ = PredictedSurface(box_.volume, box_.surface);
  ASSERT_EQ(surface_.pieceCount(), 2u);
  Points predicted = boxAt(kFlat);
  for (Eigen::Index t = 0; t < box_.volume.tets.rows(); ++t) {
    if (surface_.pieceOf({static_cast<int>(t), Eigen::Vector4d::Unit(0)}) == 0) continue;
    for (int k = 0; k < 4; ++k) {
      const int vertex = box_.volume.tets(t, k);
      predicted(vertex, 1) = box_.volume.rest_vertices(vertex, 1) + 10.0 * kPixel;
    }
  }
  const std::vector<Association> found = associate(predicted);
  EXPECT_GT(found.size(), 10u);
  for (const Association& a : found) EXPECT_EQ(a.piece, 1u);
}

/// A limb of 10 px before the rim of a trunk is gone from where it was predicted: behind its other side the
/// trunk ends, which says nothing of the limb.
TEST_F(OutlineAssociationsTest, WhatIsBeyondALimbIsNotTheLimb) {
  const BoxBody trunk = box_;
  const Eigen::Index count = trunk.volume.rest_vertices.rows();
  Points& vertices = box_.volume.rest_vertices;
  vertices.conservativeResize(2 * count, 3);
  vertices.bottomRows(count) = trunk.volume.rest_vertices * Eigen::Vector3d(0.035, 0.6, 0.2).asDiagonal();
  vertices.bottomRows(count).rowwise() += Eigen::RowVector3d(0.0835, 0.0, -0.1);
  const auto both = [&](const auto& once) {
    auto twice = once;
    twice.conservativeResize(2 * once.rows(), Eigen::NoChange);
    twice.bottomRows(once.rows()) = once.array() + static_cast<int>(count);
    return twice;
  };
  box_.volume.tets = both(trunk.volume.tets);
  box_.volume.surface = box_.surface.triangles = both(trunk.volume.surface);
  box_.surface.rest_vertices = vertices;
  surface_ = PredictedSurface(box_.volume, box_.surface);
  ASSERT_EQ(surface_.pieceCount(), 2u);
  Points moved = boxAt(kFlat);
  moved.bottomRows(count).rowwise() += Eigen::RowVector3d(0.06, 0.0, 0.0);
  frame_ = renderFrame(box_, moved, 1);
  for (const Association& a : associate(boxAt(kFlat))) EXPECT_NE(a.piece, 1u) << a.predicted.transpose();
}

TEST_F(OutlineAssociationsTest, WeighTheLengthOfTheOutline) {
  double sum = 0.0;
  const Points predicted = boxAt(kFlat + Eigen::Vector3d(10.0 * kPixel, 0.0, 0.0));
  for (const Association& a : associate(predicted)) sum += a.weight;
  const double edge = meanEdgeLength(box_.volume.rest_vertices, box_.volume.tets);
  EXPECT_NEAR(sum * edge, 2.0 * 0.1, 0.04) << "both short sides";
  double doubled = 0.0;
  for (const Association& a : associate(predicted, Eigen::Isometry3d::Identity(), 2.0)) doubled += a.weight;
  EXPECT_NEAR(doubled, 2.0 * sum, 1e-9);
  EXPECT_TRUE(associate(predicted, Eigen::Isometry3d::Identity(), 0.0).empty());
}

}  // namespace
}  // namespace softbody
