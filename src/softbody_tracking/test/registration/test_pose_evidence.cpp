#include "agreement/pose_evidence.h"

#include <gtest/gtest.h>

#include "registration/box_mesh.h"
#include "registration/search_near_pose.h"
#include "softbody_common/rigid_fit.h"

namespace softbody {
namespace {

constexpr double kTable = 0.6;  // [m]
const RegistrationConfig kConfig;

/// The box flat on a table, seen from above; its upper side is 0.04 m nearer.
Eigen::Isometry3d onTable(double x = 0.0, double y = 0.0, double lifted = 0.0) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, kTable - 0.02 - lifted));
}

/// Boxes on a table, with noise.
RgbdFrame boxesOnTable(const std::vector<Eigen::Isometry3d>& poses) {
  RgbdFrame frame = renderFrame(kBox, transformed(kMesh.vertices, poses.front()), 1);
  for (const Eigen::Isometry3d& pose : poses)
    frame.depth = cv::min(frame.depth, renderFrame(kBox, transformed(kMesh.vertices, pose), 1).depth);
  frame.depth = cv::min(frame.depth, kTable);
  cv::Mat1f noise(frame.depth.size());
  cv::theRNG().state = 1;
  cv::randn(noise, 0.0, 0.002);
  frame.depth += noise;
  return frame;
}

Confinement confinementIn(const RgbdFrame& frame, const Eigen::Isometry3d& pose = onTable(),
                          const TriangleMesh& mesh = kMesh) {
  return confinementOf(frame, mesh, pose, kConfig.distance_scale_m);
}

TEST(Confinement, IsOneForABodyThatStandsFree) {
  const Confinement free = confinementIn(boxesOnTable({onTable()}));
  EXPECT_GT(free.both_ways, 0.9);
  EXPECT_GT(free.each_way, 0.9);
}

TEST(Confinement, IsAHalfBesideANeighbourThatTouches) {
  for (const auto& [x, y] : {std::pair(0.204, 0.0), std::pair(0.0, 0.104), std::pair(-0.2, 0.0)}) {
    const Confinement beside = confinementIn(boxesOnTable({onTable(), onTable(x, y)}));
    EXPECT_NEAR(beside.both_ways, 0.55, 0.1) << x << " " << y;
    EXPECT_LT(beside.each_way, 0.5 * beside.both_ways) << x << " " << y;
  }
}

TEST(Confinement, IsAHalfIfHalfIsHidden) {
  for (const double before : {0.04, 0.14})
    EXPECT_NEAR(confinementIn(boxesOnTable({onTable(), onTable(0.1, 0.0, before)})).both_ways, 0.5, 0.1);
}

TEST(Confinement, IsZeroWhereTheMeshMaySlide) {
  const Eigen::Isometry3d sunk = Eigen::Translation3d(0.0, 0.25, 0.04) * onTable();
  EXPECT_LT(confinementIn(boxesOnTable({onTable()}), sunk).both_ways, 0.1);
  // Between two others, as long as they are.
  EXPECT_LT(confinementIn(boxesOnTable({onTable(0.1), onTable(-0.1)})).both_ways, 0.1);
  const Eigen::Isometry3d outside(Eigen::Translation3d(0.0, 0.0, -1.0));
  EXPECT_EQ(confinementIn(boxesOnTable({onTable()}), outside).both_ways, 0.0);
}

/// In a corner of a larger body two sides have edges.
TEST(Confinement, IsSmallEachWayForASmallerMesh) {
  const TriangleMesh smaller{0.7 * kMesh.vertices, kMesh.triangles};
  const double height = kTable - 0.04 + 0.7 * 0.02;
  const RgbdFrame frame = boxesOnTable({onTable()});
  for (const double aside : {0.0, 1.0}) {
    const Eigen::Isometry3d pose(Eigen::Translation3d(0.03 * aside, 0.015 * aside, height));
    EXPECT_LT(confinementIn(frame, pose, smaller).each_way, kLeastConfinement) << aside;
  }
}

TEST(Confinement, WorksForABodyThinnerThanTheDistanceScale) {
  BoxBody thin = kBox;
  thin.surface.rest_vertices.col(2) *= 0.1;
  const TriangleMesh mesh{thin.surface.rest_vertices, thin.surface.triangles};
  const Eigen::Isometry3d pose(Eigen::Translation3d(0.0, 0.0, kTable - 0.002));
  RgbdFrame frame = renderFrame(thin, transformed(mesh.vertices, pose), 1);
  frame.depth.setTo(kTable, frame.depth > 1.0f);
  EXPECT_GT(confinementIn(frame, pose, mesh).each_way, 0.9);
}

SearchOutcome searchNear(const RgbdFrame& frame, const Eigen::Isometry3d& rough) {
  return searchNearAccepted(frame, makeSearchMeshes(kMesh), roughPose(rough, kConfig), kConfig);
}

/// Rough poses about as far from the truth as their standard deviations.
std::vector<Eigen::Isometry3d> roughPoses() {
  std::vector<Eigen::Isometry3d> poses;
  for (const double sign : {1.0, -1.0})
    poses.push_back(Eigen::Translation3d(0.02 * sign, -0.015, 0.01) * onTable() *
                    Eigen::AngleAxisd(0.15 * sign, Eigen::Vector3d(0.3, 0.2, 1.0).normalized()));
  return poses;
}

TEST(SearchNearPose, FindsTheBodyAmongOthers) {
  const std::vector<std::vector<Eigen::Isometry3d>> scenes = {
      {onTable(), onTable(0.204)},                      // a twin beside it
      {onTable(), onTable(0.0, 0.104), onTable(0.21)},  // two
      {onTable(), onTable(0.133, 0.0, 0.04)},           // something on a third
      {onTable(), onTable(0.1, 0.0, 0.14)},             // half behind something
  };
  for (std::size_t scene = 0; scene < scenes.size(); ++scene) {
    for (const Eigen::Isometry3d& rough : roughPoses()) {
      const SearchOutcome outcome = searchNear(boxesOnTable(scenes[scene]), rough);
      ASSERT_TRUE(outcome.found) << scene;
      const Points difference =
          transformed(kMesh.vertices, outcome.found->pose) - transformed(kMesh.vertices, onTable());
      EXPECT_LT(difference.rowwise().norm().maxCoeff(), 0.5 * kConfig.distance_scale_m) << scene;
    }
  }
}

TEST(SearchNearPose, TakesNothingElsewhere) {
  for (const double x : {0.22, -0.25})
    EXPECT_FALSE(searchNear(boxesOnTable({onTable(x)}), onTable()).found) << x;
}

}  // namespace
}  // namespace softbody
