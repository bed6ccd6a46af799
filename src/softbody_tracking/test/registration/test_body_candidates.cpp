#include <gtest/gtest.h>

#include "fixtures/synthetic_scene.h"
#include "registration/body_candidates.h"
#include "registration/box_mesh.h"
#include "softbody_common/geometry/rigid_fit.h"
#include "softbody_tracking/tracker_config.h"

namespace softbody {
namespace {

constexpr double kDiameter = 0.2272;

std::vector<BodyCandidate> candidatesIn(const RgbdFrame& frame, double diameter_m = kDiameter,
                                        const RegionColors& colors = RegionColors()) {
  return findBodyCandidates(frame, colors, diameter_m);
}

TEST(BodyCandidates, AreTheObjectsBeforeTheWall) {
  const Points vertices = transformed(kMesh.vertices, boxPose());
  const auto candidates = candidatesIn(renderFrame(kBox, vertices, 1));
  ASSERT_EQ(candidates.size(), 1u);
  EXPECT_LT((candidates.front().center - boxPose().translation()).norm(), 0.04);
}

TEST(BodyCandidates, AreEmptyOnABareWallOrWithoutDepth) {
  RgbdFrame frame = renderFrame(kBox, transformed(kMesh.vertices, boxPose()), 1);
  frame.depth.setTo(1.2f);
  EXPECT_TRUE(candidatesIn(frame).empty());
  frame.depth.setTo(0.0f);
  EXPECT_TRUE(candidatesIn(frame).empty());
}

RgbdFrame bareWall() {
  RgbdFrame frame = renderFrame(kBox, transformed(kMesh.vertices, boxPose()), 1);
  frame.depth.setTo(1.2f);
  return frame;
}

TEST(BodyCandidates, ContainAFlatBodyAlthoughOtherObjectsLieInItsPlane) {
  RgbdFrame frame = bareWall();
  for (const cv::Rect& square : {cv::Rect(300, 140, 200, 200), cv::Rect(10, 10, 80, 80)})
    frame.depth(square).setTo(0.6f);
  const auto candidates = candidatesIn(frame, 0.25);
  ASSERT_FALSE(candidates.empty());
  EXPECT_LT((candidates.front().center - frame.camera.unproject(400, 240, 0.6)).norm(), 0.02);
}

TEST(BodyCandidates, ContainNoPartOfATableThatAnArmDivides) {
  RgbdFrame frame = bareWall();
  frame.depth.colRange(288, 352).setTo(0.0f);  // at its edges depth is missing
  frame.depth.colRange(290, 350).setTo(0.6f);
  constexpr double kLargeDiameter = 0.65;  // a half of the wall alone is not too large for it
  const auto candidates = candidatesIn(frame, kLargeDiameter);
  ASSERT_EQ(candidates.size(), 1u);
  EXPECT_NEAR(candidates.front().center.z(), 0.6, 0.01) << "the arm";
}

const cv::Vec3b kBodyColor(40, 60, 220), kTableColor(200, 190, 60);

/// As of a frame that shows the body on the left half of the table.
RegionColors bodyColors() {
  RgbdFrame frame;
  frame.color = cv::Mat3b(100, 100, kTableColor);
  frame.depth = cv::Mat1f(100, 100, 1.0f);
  frame.color.colRange(0, 50).setTo(kBodyColor);
  Labels labels;
  labels.region = cv::Rect(0, 0, 100, 100);
  labels.label = cv::Mat1b(100, 100, labels::kBackground);
  labels.label.colRange(0, 50).setTo(labels::kBody);
  RasterImage rendered;
  rendered.depth = cv::Mat1f(100, 100, 1.0f);
  rendered.triangle = cv::Mat1i(100, 100, 0);
  RegionColors colors;
  colors.learn(frame, rendered, labels, 1.0);
  return colors;
}

TEST(BodyCandidates, ContainNoSpecklesOfATable) {
  RgbdFrame frame = bareWall();
  frame.color.setTo(kTableColor);
  for (int v = 0; v < 480; v += 80)
    for (int u = 0; u < 640; u += 80) frame.color(cv::Rect(u, v, 60, 60)).setTo(kBodyColor);
  EXPECT_TRUE(candidatesIn(frame, kDiameter, bodyColors()).empty());
}

TEST(BodyCandidates, ContainAThinBodyOnATableByItsColors) {
  RgbdFrame frame = bareWall();
  frame.color.setTo(kTableColor);
  const cv::Rect body(250, 150, 130, 110);
  frame.color(body).setTo(kBodyColor);
  frame.depth(body).setTo(1.198f);
  EXPECT_EQ(candidatesIn(frame, kDiameter, bodyColors()).size(), 1u);
}

/// Three squares of 8 cm side by side before a wall; the middle one is farther away by a step.
RgbdFrame threeSquares(double step_m) {
  RgbdFrame frame = bareWall();
  constexpr double kWidth = 0.08, kNear = 0.6;
  for (int part = 0; part < 3; ++part) {
    const double z = part == 1 ? kNear + step_m : kNear;
    const int side = cvRound(kWidth * frame.camera.fx / kNear);
    frame.depth(cv::Rect(200 + part * side, 200, side, side)).setTo(static_cast<float>(z));
  }
  return frame;
}

TEST(BodyCandidates, KeepABodyTogetherThatHidesPartsOfItself) {
  constexpr double kLargeDiameter = 0.4;  // each square alone is too small for it
  EXPECT_EQ(candidatesIn(threeSquares(0.04), kLargeDiameter).size(), 1u);
  EXPECT_TRUE(candidatesIn(threeSquares(0.1), kLargeDiameter).empty());
}

}  // namespace
}  // namespace softbody
