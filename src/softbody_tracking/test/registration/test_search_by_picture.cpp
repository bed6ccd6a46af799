#include <gtest/gtest.h>

#include <random>

#include "fixtures/painted_box.h"
#include "registration/search_anywhere.h"
#include "registration/search_near_pose.h"

namespace softbody {
namespace {

double unknownFeatures(const Eigen::Isometry3d&) { return -1.0; }

SearchOutcome searched(const RgbdFrame& frame, const SearchMeshes& meshes) {
  return searchAnywhere(frame, RegionColors(), meshes, {}, unknownFeatures);
}

double turnBetween(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return Eigen::AngleAxisd((a.inverse() * b).linear()).angle();
}

/// Before the left one, the other hides what it is nearer than.
RgbdFrame nearest(const RgbdFrame& one, const RgbdFrame& other) {
  RgbdFrame frame = one;
  other.color.copyTo(frame.color, other.depth < one.depth);
  frame.depth = cv::min(one.depth, other.depth);
  return frame;
}

TEST(SearchByPicture, FindsTheRightOfTheAlikePoses) {
  std::mt19937 random(6);
  std::normal_distribution<double> normal;
  for (const double contrast : {1.0, 0.12}) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const PaintedBox painted(cells(seed, contrast));
      const Eigen::Quaterniond turn(normal(random), normal(random), normal(random), normal(random));
      const Eigen::Isometry3d truth =
          Eigen::Translation3d(0.04 * normal(random), 0.03 * normal(random), 0.55) * turn.normalized();
      const RgbdFrame frame = painted.frameAt(truth, {0.8, 0.9, 1.0});
      const auto found = searched(frame, makeSearchMeshes(painted.box.surface, painted.picture)).found;
      ASSERT_TRUE(found) << contrast << " " << seed;
      EXPECT_EQ(found->alike, 1);
      EXPECT_LT(turnBetween(found->pose, truth), 0.1) << contrast << " " << seed;
    }
  }
}

TEST(SearchByPicture, TakesNoOtherBodyOfTheSameShape) {
  const Eigen::Isometry3d pose = boxPose();
  const PaintedBox red(cells(1, 0.0, {50, 60, 180})), green(cells(1, 0.0, {60, 160, 60})),
      rich(cells(1, 1.0)), other(cells(2, 1.0));
  EXPECT_TRUE(searched(red.frameAt(pose), makeSearchMeshes(red.box.surface, red.picture)).found);
  EXPECT_FALSE(searched(green.frameAt(pose), makeSearchMeshes(red.box.surface, red.picture)).found);
  const SearchOutcome refused =
      searched(other.frameAt(pose), makeSearchMeshes(rich.box.surface, rich.picture));
  EXPECT_FALSE(refused.found);
  EXPECT_GT(refused.refused.by_picture, 0);
  EXPECT_LE(refused.refused.by_depth + refused.refused.by_picture, refused.refused.tried);
}

/// A body without a picture must stand free.
TEST(SearchByPicture, FindsABodyThatSomethingHides) {
  const PaintedBox rich(cells(1, 1.0)), other(cells(2, 1.0));
  const Eigen::Isometry3d truth = boxPose();
  const RgbdFrame frame =
      nearest(rich.frameAt(truth), other.frameAt(Eigen::Translation3d(0.09, 0.03, -0.08) * truth));
  const auto found = searched(frame, makeSearchMeshes(rich.box.surface, rich.picture)).found;
  ASSERT_TRUE(found);
  EXPECT_LT((found->pose.translation() - truth.translation()).norm(), 0.01);
  EXPECT_LT(turnBetween(found->pose, truth), 0.1);
}

TEST(SearchByPicture, TakesNoneOfTwoTwins) {
  const PaintedBox rich(cells(1, 1.0));
  const RgbdFrame frame = nearest(rich.frameAt(Eigen::Translation3d(-0.12, 0.0, 0.0) * boxPose()),
                                  rich.frameAt(Eigen::Translation3d(0.13, 0.0, 0.05) * boxPose()));
  const SearchOutcome outcome = searched(frame, makeSearchMeshes(rich.box.surface, rich.picture));
  EXPECT_FALSE(outcome.found);
  EXPECT_TRUE(outcome.refused.several);
}

/// Within the uncertainty of a rough pose the picture decides; beyond it does not count.
TEST(SearchByPicture, TakesTheTurnThatARoughPoseAllows) {
  const PaintedBox rich(cells(1, 1.0));
  const SearchMeshes meshes = makeSearchMeshes(rich.box.surface, rich.picture);
  const Eigen::Isometry3d truth = boxPose();
  const RgbdFrame frame = rich.frameAt(truth);
  for (const Eigen::Isometry3d& turn : alikeTurns()) {
    RoughPose rough{truth * turn, 0.03, 1.2};
    EXPECT_LT(turnBetween(searchNearPose(frame, meshes, rough).pose, truth), 0.1);
    rough.std_rad = 0.26;
    EXPECT_LT(turnBetween(searchNearPose(frame, meshes, rough).pose, rough.pose), 0.1);
  }
}

}  // namespace
}  // namespace softbody
