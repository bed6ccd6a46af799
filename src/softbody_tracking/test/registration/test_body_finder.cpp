#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "fixtures/synthetic_scene.h"
#include "registration/body_finder.h"
#include "registration/object_candidates.h"
#include "registration/pose_search.h"
#include "softbody_common/rigid_fit.h"

namespace softbody {
namespace {

const BoxBody kBox = makeBox();
const TriangleMesh kMesh{kBox.surface.rest_vertices, kBox.surface.triangles};
constexpr double kDiameter = 0.2272;

TEST(ObjectCandidates, AreWhatStandsBeforeTheWall) {
  const Points vertices = transformed(kMesh.vertices, boxPose());
  const auto candidates = findObjectCandidates(renderFrame(kBox, vertices, 1), ColorModel(), kDiameter);
  ASSERT_EQ(candidates.size(), 1u);
  EXPECT_LT((candidates.front().center - boxPose().translation()).norm(), 0.04);
}

TEST(ObjectCandidates, AreNoneOnABareWallOrWithoutDepth) {
  RgbdFrame frame = renderFrame(kBox, transformed(kMesh.vertices, boxPose()), 1);
  frame.depth.setTo(1.2f);
  EXPECT_TRUE(findObjectCandidates(frame, ColorModel(), kDiameter).empty());
  frame.depth.setTo(0.0f);
  EXPECT_TRUE(findObjectCandidates(frame, ColorModel(), kDiameter).empty());
}

RgbdFrame bareWall() {
  RgbdFrame frame = renderFrame(kBox, transformed(kMesh.vertices, boxPose()), 1);
  frame.depth.setTo(1.2f);
  return frame;
}

TEST(ObjectCandidates, HoldAFlatBodyAlthoughOtherThingsLieInItsPlane) {
  RgbdFrame frame = bareWall();
  for (const cv::Rect& square : {cv::Rect(300, 140, 200, 200), cv::Rect(10, 10, 80, 80)})
    frame.depth(square).setTo(0.6f);
  const auto candidates = findObjectCandidates(frame, ColorModel(), 0.25);
  ASSERT_FALSE(candidates.empty());
  EXPECT_LT((candidates.front().center - frame.camera.unproject(400, 240, 0.6)).norm(), 0.02);
}

TEST(ObjectCandidates, AreNoPartsOfATableThatAnArmParts) {
  RgbdFrame frame = bareWall();
  frame.depth.colRange(288, 352).setTo(0.0f);  // at its edges depth is missing
  frame.depth.colRange(290, 350).setTo(0.6f);
  constexpr double kLargeDiameter = 0.65;  // a half of the wall alone is not too large for it
  const auto candidates = findObjectCandidates(frame, ColorModel(), kLargeDiameter);
  ASSERT_EQ(candidates.size(), 1u);
  EXPECT_NEAR(candidates.front().center.z(), 0.6, 0.01) << "the arm";
}

const cv::Vec3b kBodyColor(40, 60, 220), kTableColor(200, 190, 60);

ColorModel bodyColors() {
  ColorModel colors;
  colors.learn(cv::Mat3b(100, 100, kBodyColor), cv::Mat1b(100, 100, 255));
  return colors;
}

TEST(ObjectCandidates, AreNoSpecklesOfATable) {
  RgbdFrame frame = bareWall();
  frame.color.setTo(kTableColor);
  for (int v = 0; v < 480; v += 80)
    for (int u = 0; u < 640; u += 80) frame.color(cv::Rect(u, v, 60, 60)).setTo(kBodyColor);
  EXPECT_TRUE(findObjectCandidates(frame, bodyColors(), kDiameter).empty());
}

TEST(ObjectCandidates, HoldAThinBodyOnATableByItsColors) {
  RgbdFrame frame = bareWall();
  frame.color.setTo(kTableColor);
  const cv::Rect body(250, 150, 130, 110);
  frame.color(body).setTo(kBodyColor);
  frame.depth(body).setTo(1.198f);
  EXPECT_EQ(findObjectCandidates(frame, bodyColors(), kDiameter).size(), 1u);
}

/// Two squares side by side, one further away by a step that only large pieces have.
void addSteppedThing(int left_px, cv::Mat1f* depth) {
  (*depth)(cv::Rect(left_px, 20, 150, 150)).setTo(0.5f);
  (*depth)(cv::Rect(left_px + 150, 20, 150, 150)).setTo(0.53f);
}

TEST(ObjectCandidates, HoldEveryThingBeforeOtherPartsOfOne) {
  Eigen::Isometry3d pose = boxPose();
  pose.translation() = Eigen::Vector3d(0.0, 0.15, 1.0);
  RgbdFrame frame = renderFrame(kBox, transformed(kMesh.vertices, pose), 1);
  for (int left_px : {10, 330}) addSteppedThing(left_px, &frame.depth);
  const auto candidates = findObjectCandidates(frame, ColorModel(), kDiameter);
  ASSERT_GT(candidates.size(), 3u);
  const auto is_body = [&](const ObjectCandidate& candidate) {
    return (candidate.center - pose.translation()).norm() < 0.05;
  };
  EXPECT_TRUE(std::any_of(candidates.begin(), candidates.begin() + 3, is_body));
}

/// A wall, and before it three squares side by side, 8 cm wide, the middle one further away by a step.
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

TEST(ObjectCandidates, HoldTogetherABodyThatHidesPartsOfItself) {
  constexpr double kLargeDiameter = 0.4;  // each square alone is too small for it
  EXPECT_EQ(findObjectCandidates(threeSquares(0.04), ColorModel(), kLargeDiameter).size(), 1u);
  EXPECT_TRUE(findObjectCandidates(threeSquares(0.1), ColorModel(), kLargeDiameter).empty());
}

TEST(ClusteredMesh, KeepsTheShapeWithinACell) {
  const TriangleMesh coarse = clustered(kMesh, 0.03);
  EXPECT_LT(coarse.vertices.rows(), kMesh.vertices.rows());
  EXPECT_GT(coarse.triangles.rows(), 20);
  for (Eigen::Index v = 0; v < coarse.vertices.rows(); ++v)
    EXPECT_LT((kMesh.vertices.rowwise() - coarse.vertices.row(v)).rowwise().norm().minCoeff(), 0.03);
}

TEST(ClusteredMesh, KeepsAThreadThinnerThanACell) {
  TriangleMesh thread = kMesh;
  thread.vertices.rightCols(2) *= 0.05;
  thread.vertices.rightCols(2).array() += 0.01;  // in a single row of cells
  const TriangleMesh coarse = clustered(thread, 0.03);
  EXPECT_GT(coarse.triangles.rows(), 20);
  EXPECT_LT(coarse.vertices.col(0).minCoeff(), -0.08);
  EXPECT_GT(coarse.vertices.col(0).maxCoeff(), 0.08);
}

TEST(BodyFinder, FindsTheBodyInAnyOrientation) {
  const BodyFinder finder(kMesh, RegistrationConfig());
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 5; ++trial) {
    const Eigen::Quaterniond q(normal(random), normal(random), normal(random), normal(random));
    const Eigen::Isometry3d pose =
        Eigen::Translation3d(0.05 * normal(random), 0.04 * normal(random), 0.55) * q.normalized();
    const Points truth = transformed(kMesh.vertices, pose);
    const auto found = finder.find(renderFrame(kBox, truth, 1), ColorModel(), {});
    ASSERT_FALSE(found.empty());
    EXPECT_LT(found.front().cost, 0.05);
    const Points vertices = transformed(kMesh.vertices, found.front().pose);
    EXPECT_LT((vertices.colwise().mean() - truth.colwise().mean()).norm(), 0.02) << "trial " << trial;
  }
}

TEST(PoseSearch, NothingSpeaksForWhatIsImplausible) {
  const RgbdFrame frame = renderFrame(kBox, transformed(kMesh.vertices, boxPose()), 1);
  PoseSearch search(frame, kMesh, RegistrationConfig().distance_scale_m);
  EXPECT_GT(search.support(boxPose()), 1000.0);
  for (double aside_m : {0.05, 0.2, 5.0})
    EXPECT_EQ(search.support(Eigen::Translation3d(aside_m, 0.0, 0.0) * boxPose()), 0.0) << aside_m;
}

TEST(BodyFinder, LooksCloselyAtEveryPlaceThoughOthersFitInManyWays) {
  Points bent = kMesh.vertices;
  for (auto vertex : bent.rowwise()) vertex.z() += 5.0 * vertex.x() * vertex.x();
  const Eigen::Isometry3d near = Eigen::Translation3d(-0.1, 0.0, 0.0) * boxPose();
  RgbdFrame frame = renderFrame(kBox, transformed(bent, near), 1);
  for (double y : {-0.15, 0.15}) {
    const Points far = transformed(kMesh.vertices, Eigen::Translation3d(0.25, y, 0.3) * boxPose());
    frame.depth = cv::min(frame.depth, renderFrame(kBox, far, 1).depth);
  }
  const auto found = BodyFinder(kMesh, RegistrationConfig()).find(frame, ColorModel(), {});
  EXPECT_TRUE(std::any_of(found.begin(), found.end(), [&](const RegistrationResult& pose) {
    return (pose.pose.translation() - near.translation()).norm() < 0.05;
  }));
}

TEST(BodyFinder, BelievesManyPixelsRatherThanFew) {
  Eigen::Isometry3d near = boxPose(), far = boxPose();
  near.translation().x() -= 0.1;
  far.translation() += Eigen::Vector3d(0.2, 0.1, 0.45);
  RgbdFrame frame = renderFrame(kBox, transformed(kMesh.vertices, near), 1);
  const RgbdFrame other = renderFrame(kBox, transformed(kMesh.vertices, far), 1);
  cv::Mat1f noise(frame.depth.size());
  cv::theRNG().state = 1;
  cv::randn(noise, 0.0, 0.005);
  cv::add(frame.depth, noise, frame.depth, frame.depth < 1.0f);
  frame.depth = cv::min(frame.depth, other.depth);
  const auto found = BodyFinder(kMesh, RegistrationConfig()).find(frame, ColorModel(), {});
  ASSERT_GE(found.size(), 2u);
  EXPECT_LT((found.front().pose.translation() - near.translation()).norm(), 0.03);
  EXPECT_GT(found.front().cost, found[1].cost) << "the far one fits better";
}

}  // namespace
}  // namespace softbody
