#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "fixtures/synthetic_scene.h"
#include "registration/box_mesh.h"
#include "registration/search_anywhere.h"
#include "softbody_common/geometry/rigid_fit.h"

namespace softbody {
namespace {

const SearchMeshes& boxMeshes() {
  static const SearchMeshes result = makeSearchMeshes(kMesh);
  return result;
}

/// Searches without colours.
std::optional<FoundPose> search(const RgbdFrame& frame, const FeatureShare& feature_share,
                                const std::vector<Eigen::Isometry3d>& guesses = {},
                                const SearchMeshes& meshes = boxMeshes()) {
  return searchAnywhere(frame, RegionColors(), meshes, guesses, feature_share).found;
}

std::vector<PoseHypothesis> boxPoses(const RgbdFrame& frame) {
  return posesAnywhere(frame, RegionColors(), boxMeshes(), {});
}

Eigen::Isometry3d nearPose() { return Eigen::Translation3d(-0.1, 0.0, 0.0) * boxPose(); }
Eigen::Isometry3d farPose() { return Eigen::Translation3d(0.2, 0.1, 0.3) * boxPose(); }

/// A body whose depth is exact, or noisy.
RgbdFrame bodyAt(const Eigen::Isometry3d& pose, double noise_m) {
  RgbdFrame frame = renderFrame(kBox, transformed(kMesh.vertices, pose), 1);
  cv::Mat1f noise(frame.depth.size());
  cv::theRNG().state = 1;
  cv::randn(noise, 0.0, noise_m);
  cv::add(frame.depth, noise, frame.depth, frame.depth < 1.2f);
  return frame;
}

RgbdFrame both(const RgbdFrame& one, const RgbdFrame& other) {
  RgbdFrame frame = one;
  other.color.copyTo(frame.color, other.depth < one.depth);
  frame.depth = cv::min(one.depth, other.depth);
  return frame;
}

bool isAt(const Eigen::Isometry3d& pose, const Eigen::Isometry3d& place) {
  return (pose.translation() - place.translation()).norm() < 0.05;
}

double unknown(const Eigen::Isometry3d&) { return -1.0; }

TEST(PosesAnywhere, FindTheBodyInAnyOrientation) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 5; ++trial) {
    const Eigen::Quaterniond q(normal(random), normal(random), normal(random), normal(random));
    const Eigen::Isometry3d pose =
        Eigen::Translation3d(0.05 * normal(random), 0.04 * normal(random), 0.55) * q.normalized();
    const Points truth = transformed(kMesh.vertices, pose);
    const auto found = boxPoses(renderFrame(kBox, truth, 1));
    ASSERT_FALSE(found.empty());
    EXPECT_LT(found.front().cost, 0.05);
    const Points vertices = transformed(kMesh.vertices, found.front().pose);
    EXPECT_LT((vertices.colwise().mean() - truth.colwise().mean()).norm(), 0.02) << "trial " << trial;
  }
}

TEST(PosesAnywhere, IncludeEveryPlaceThoughOthersFitInManyWays) {
  Points bent = kMesh.vertices;
  for (auto vertex : bent.rowwise()) vertex.z() += 5.0 * vertex.x() * vertex.x();
  const Eigen::Isometry3d near = Eigen::Translation3d(-0.1, 0.0, 0.0) * boxPose();
  RgbdFrame frame = renderFrame(kBox, transformed(bent, near), 1);
  for (double y : {-0.15, 0.15}) {
    const Points far = transformed(kMesh.vertices, Eigen::Translation3d(0.25, y, 0.3) * boxPose());
    frame.depth = cv::min(frame.depth, renderFrame(kBox, far, 1).depth);
  }
  const auto found = boxPoses(frame);
  EXPECT_TRUE(std::any_of(found.begin(), found.end(), [&](const PoseHypothesis& pose) {
    return (pose.pose.translation() - near.translation()).norm() < 0.05;
  }));
}

TEST(PosesAnywhere, PreferManyPixelsToFew) {
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
  const auto found = boxPoses(frame);
  ASSERT_FALSE(found.empty());
  EXPECT_LT((found.front().pose.translation() - near.translation()).norm(), 0.03);
  EXPECT_TRUE(std::any_of(found.begin(), found.end(), [&](const PoseHypothesis& pose) {
    return isAt(pose.pose, far) && pose.cost < found.front().cost;
  })) << "the far one fits better";
}

TEST(SearchAnywhere, CountsAlikePosesInOnePlaceOnly) {
  const RgbdFrame noisy = bodyAt(nearPose(), 0.004);
  const auto alone = search(noisy, unknown);
  const auto beside = search(both(noisy, bodyAt(farPose(), 0.0)), unknown);
  ASSERT_TRUE(alone && beside);
  EXPECT_GT(alone->alike, 1) << "a box has poses that look alike";
  EXPECT_EQ(beside->alike, alone->alike);
  EXPECT_TRUE(isAt(beside->pose, nearPose()));
}

TEST(SearchAnywhere, DoesNotCountWorsePosesAsAlike) {
  BoxBody wedge = kBox;
  for (auto vertex : wedge.surface.rest_vertices.rowwise()) {
    vertex.z() *= 1.0 + 6.0 * vertex.x() + 5.0 * vertex.y();
    vertex.y() *= 1.0 + 2.0 * vertex.x();
  }
  const TriangleMesh mesh{wedge.surface.rest_vertices, wedge.surface.triangles};
  const RgbdFrame frame = renderFrame(wedge, transformed(mesh.vertices, boxPose()), 1);
  const auto found = search(frame, unknown, {}, makeSearchMeshes(mesh));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->alike, 1);
}

/// It is thinner than the cells of the coarse mesh.
TEST(SearchAnywhere, FindsAThread) {
  BoxBody thread = makeBox(220, 4, 4);
  thread.surface.rest_vertices.col(1) *= 0.03;
  thread.surface.rest_vertices.col(2) *= 0.06;
  thread.surface.rest_vertices.rightCols(2).array() += 0.0017;  // in a single row of cells
  const TriangleMesh mesh{thread.surface.rest_vertices, thread.surface.triangles};
  const RgbdFrame frame = renderFrame(thread, transformed(mesh.vertices, boxPose()), 1);
  const auto found = search(frame, unknown, {boxPose()}, makeSearchMeshes(mesh));
  ASSERT_TRUE(found);
  EXPECT_TRUE(isAt(found->pose, boxPose()));
}

TEST(SearchAnywhere, TakesTheNextPlaceIfFeaturesConfirmIt) {
  const RgbdFrame frame = both(bodyAt(nearPose(), 0.0), bodyAt(farPose(), 0.005));
  for (double share_of_near : {0.0, -1.0}) {
    const auto found = search(
        frame, [&](const Eigen::Isometry3d& pose) { return isAt(pose, farPose()) ? 0.8 : share_of_near; });
    ASSERT_TRUE(found);
    EXPECT_TRUE(isAt(found->pose, farPose()));
    EXPECT_EQ(found->alike, 1);
  }
}

TEST(SearchAnywhere, DoesNotTakeTheNextPlaceUnlessFeaturesConfirmIt) {
  const RgbdFrame frame = both(bodyAt(nearPose(), 0.0), bodyAt(farPose(), 0.005));
  for (double share_of_far : {0.0, -1.0}) {
    EXPECT_FALSE(search(
        frame, [&](const Eigen::Isometry3d& pose) { return isAt(pose, nearPose()) ? 0.0 : share_of_far; }));
  }
}

/// After a loss: without its features the body is taken only near its last place, in any turn.
TEST(SearchAnywhere, TakesAPlaceThatIsNotExpectedOnlyIfFeaturesConfirmIt) {
  const RgbdFrame frame = bodyAt(farPose(), 0.002);
  const auto searched = [&](const Eigen::Isometry3d& last, double share) {
    const auto feature_share = [&](const Eigen::Isometry3d&) { return share; };
    return searchAnywhere(frame, RegionColors(), boxMeshes(), {}, feature_share,
                          roughPose(last, RegistrationConfig()))
        .found;
  };
  EXPECT_FALSE(searched(nearPose(), -1.0)) << "another thing of this shape";
  EXPECT_TRUE(searched(nearPose(), 0.9));
  const Eigen::Isometry3d turned =
      Eigen::Translation3d(0.02, 0.0, 0.02) * farPose() * Eigen::AngleAxisd(2.0, Eigen::Vector3d::UnitZ());
  EXPECT_TRUE(searched(turned, -1.0));
}

TEST(SearchAnywhere, PrefersAnUndecidedPoseToOneWithoutItsFeatures) {
  int asked = 0;
  const auto found =
      search(bodyAt(nearPose(), 0.0), [&](const Eigen::Isometry3d&) { return asked++ == 0 ? -1.0 : 0.0; });
  EXPECT_GT(asked, 1);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->alike, 1);
}

TEST(SearchAnywhere, TriesEveryPoseOfABoxThatLooksAlike) {
  const RgbdFrame frame = bodyAt(nearPose(), 0.0);
  for (const Eigen::Vector3d& axis : {Eigen::Vector3d::Zero().eval(), Eigen::Vector3d::UnitX().eval(),
                                      Eigen::Vector3d::UnitY().eval(), Eigen::Vector3d::UnitZ().eval()}) {
    const Eigen::Isometry3d truth = nearPose() * Eigen::AngleAxisd(axis.isZero() ? 0.0 : M_PI, axis);
    const auto found = search(frame, [&](const Eigen::Isometry3d& pose) {
      return Eigen::AngleAxisd((pose.inverse() * truth).linear()).angle() < 0.2 ? 0.9 : 0.05;
    });
    EXPECT_TRUE(found) << axis.transpose();
  }
}

}  // namespace
}  // namespace softbody
