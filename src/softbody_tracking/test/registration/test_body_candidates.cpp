#include <gtest/gtest.h>

#include <algorithm>

#include "fixtures/synthetic_scene.h"
#include "registration/body_candidates.h"
#include "registration/box_mesh.h"
#include "softbody_common/rigid_fit.h"

namespace softbody {
namespace {

constexpr double kDiameter = 0.2272;

TEST(BodyCandidates, AreTheObjectsBeforeTheWall) {
  const Points vertices = transformed(kMesh.vertices, boxPose());
  const auto candidates = findBodyCandidates(renderFrame(kBox, vertices, 1), ColorModel(), kDiameter);
  ASSERT_EQ(candidates.size(), 1u);
  EXPECT_LT((candidates.front().center - boxPose().translation()).norm(), 0.04);
}

TEST(BodyCandidates, AreEmptyOnABareWallOrWithoutDepth) {
  RgbdFrame frame = renderFrame(kBox, transformed(kMesh.vertices, boxPose()), 1);
  frame.depth.setTo(1.2f);
  EXPECT_TRUE(findBodyCandidates(frame, ColorModel(), kDiameter).empty());
  frame.depth.setTo(0.0f);
  EXPECT_TRUE(findBodyCandidates(frame, ColorModel(), kDiameter).empty());
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
  const auto candidates = findBodyCandidates(frame, ColorModel(), 0.25);
  ASSERT_FALSE(candidates.empty());
  EXPECT_LT((candidates.front().center - frame.camera.unproject(400, 240, 0.6)).norm(), 0.02);
}

TEST(BodyCandidates, ContainNoPartOfATableThatAnArmDivides) {
  RgbdFrame frame = bareWall();
  frame.depth.colRange(288, 352).setTo(0.0f);  // at its edges depth is missing
  frame.depth.colRange(290, 350).setTo(0.6f);
  constexpr double kLargeDiameter = 0.65;  // a half of the wall alone is not too large for it
  const auto candidates = findBodyCandidates(frame, ColorModel(), kLargeDiameter);
  ASSERT_EQ(candidates.size(), 1u);
  EXPECT_NEAR(candidates.front().center.z(), 0.6, 0.01) << "the arm";
}

const cv::Vec3b kBodyColor(40, 60, 220), kTableColor(200, 190, 60);

ColorModel bodyColors() {
  ColorModel colors;
  colors.learn(cv::Mat3b(100, 100, kBodyColor), cv::Mat1b(100, 100, 255));
  return colors;
}

TEST(BodyCandidates, ContainNoSpecklesOfATable) {
  RgbdFrame frame = bareWall();
  frame.color.setTo(kTableColor);
  for (int v = 0; v < 480; v += 80)
    for (int u = 0; u < 640; u += 80) frame.color(cv::Rect(u, v, 60, 60)).setTo(kBodyColor);
  EXPECT_TRUE(findBodyCandidates(frame, bodyColors(), kDiameter).empty());
}

TEST(BodyCandidates, ContainAThinBodyOnATableByItsColors) {
  RgbdFrame frame = bareWall();
  frame.color.setTo(kTableColor);
  const cv::Rect body(250, 150, 130, 110);
  frame.color(body).setTo(kBodyColor);
  frame.depth(body).setTo(1.198f);
  EXPECT_EQ(findBodyCandidates(frame, bodyColors(), kDiameter).size(), 1u);
}

/// Two squares side by side; the step in depth between them occurs only inside large objects.
void addSteppedObject(int left_px, cv::Mat1f* depth) {
  (*depth)(cv::Rect(left_px, 20, 150, 150)).setTo(0.5f);
  (*depth)(cv::Rect(left_px + 150, 20, 150, 150)).setTo(0.53f);
}

TEST(BodyCandidates, ContainEveryObjectBeforeOtherPartsOfOne) {
  Eigen::Isometry3d pose = boxPose();
  pose.translation() = Eigen::Vector3d(0.0, 0.15, 1.0);
  RgbdFrame frame = renderFrame(kBox, transformed(kMesh.vertices, pose), 1);
  for (int left_px : {10, 330}) addSteppedObject(left_px, &frame.depth);
  const auto candidates = findBodyCandidates(frame, ColorModel(), kDiameter);
  ASSERT_GT(candidates.size(), 3u);
  const auto is_body = [&](const BodyCandidate& candidate) {
    return (candidate.center - pose.translation()).norm() < 0.05;
  };
  EXPECT_TRUE(std::any_of(candidates.begin(), candidates.begin() + 3, is_body));
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
  EXPECT_EQ(findBodyCandidates(threeSquares(0.04), ColorModel(), kLargeDiameter).size(), 1u);
  EXPECT_TRUE(findBodyCandidates(threeSquares(0.1), ColorModel(), kLargeDiameter).empty());
}

}  // namespace
}  // namespace softbody
