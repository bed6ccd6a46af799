#include <gtest/gtest.h>

#include <random>

#include "agreement/boxes_on_table.h"
#include "fixtures/synthetic_scene.h"
#include "registration/search_near_pose.h"
#include "softbody_common/geometry/rigid_fit.h"
#include "softbody_tracking/tracker_config.h"

namespace softbody {
namespace {

PoseHypothesis searchNear(const RgbdFrame& frame, const TriangleMesh& mesh, const Eigen::Isometry3d& rough) {
  return searchNearPose(frame, {mesh, mesh, mesh}, roughPose(rough, RegistrationConfig()));
}

TEST(SearchNearPose, FindsTheBoxFromRoughPoses) {
  const BoxBody box = makeBox();
  const Eigen::Isometry3d truth = boxPose();
  const RgbdFrame frame = renderFrame(box, transformed(box.volume.rest_vertices, truth), 1);
  const TriangleMesh mesh{box.surface.rest_vertices, box.surface.triangles};
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int trial = 0; trial < 5; ++trial) {
    const Eigen::Vector3d axis =
        Eigen::Vector3d(uniform(random), uniform(random), uniform(random)).normalized();
    const Eigen::Vector3d shift = 0.02 * Eigen::Vector3d(uniform(random), uniform(random), uniform(random));
    const Eigen::Isometry3d rough =
        Eigen::Translation3d(shift) * truth * Eigen::AngleAxisd(0.25 * uniform(random), axis);
    const PoseHypothesis found = searchNear(frame, mesh, rough);
    const Points difference = transformed(mesh.vertices, found.pose) - transformed(mesh.vertices, truth);
    EXPECT_LT(difference.rowwise().norm().maxCoeff(), 0.002) << "trial " << trial << ", cost " << found.cost;
  }
}

TEST(SearchNearPose, WorksWithACoarseMesh) {
  const BoxBody box = makeBox(40, 20, 8);
  const TriangleMesh mesh{box.surface.rest_vertices, box.surface.triangles};
  const TriangleMesh coarse = clustered(mesh, 0.012, 0.25);
  ASSERT_LT(4 * coarse.triangles.rows(), mesh.triangles.rows());
  const Eigen::Isometry3d truth = boxPose();
  const RgbdFrame frame = renderFrame(box, transformed(mesh.vertices, truth), 1);
  const Eigen::Isometry3d rough = Eigen::Translation3d(0.01, -0.015, 0.01) * truth *
                                  Eigen::AngleAxisd(0.2, Eigen::Vector3d(1, 2, -1).normalized());
  const PoseHypothesis found =
      searchNearPose(frame, {mesh, mesh, coarse}, roughPose(rough, RegistrationConfig()));
  const Points difference = transformed(mesh.vertices, found.pose) - transformed(mesh.vertices, truth);
  EXPECT_LT(difference.rowwise().norm().maxCoeff(), 0.002) << found.cost;
}

/// A flat ring around the z axis, 96 by 4 quads. @param crowding 0: even sectors; towards 1: denser on one
/// side.
TriangleMesh makeRing(double crowding = 0.0) {
  constexpr int kSectors = 96, kSides = 4;
  constexpr double kCorners[kSides][2] = {{0.05, -0.02}, {0.1, -0.02}, {0.1, 0.02}, {0.05, 0.02}};
  TriangleMesh mesh{Points(kSectors * kSides, 3), Triangles(2 * kSectors * kSides, 3)};
  for (int i = 0; i < kSectors; ++i) {
    const double even = 2.0 * M_PI * i / kSectors, angle = even + crowding * std::sin(even);
    for (int k = 0; k < kSides; ++k) {
      const auto& [radius, z] = kCorners[k];
      mesh.vertices.row(i * kSides + k) << radius * std::cos(angle), radius * std::sin(angle), z;
      const int a = i * kSides + k, b = i * kSides + (k + 1) % kSides,
                c = (i + 1) % kSectors * kSides + (k + 1) % kSides, d = (i + 1) % kSectors * kSides + k;
      mesh.triangles.row(2 * a) << a, d, c;
      mesh.triangles.row(2 * a + 1) << a, c, b;
    }
  }
  return mesh;
}

void expectTurnOfRoughPose(const TriangleMesh& mesh) {
  BoxBody ring;
  ring.surface.rest_vertices = mesh.vertices;
  ring.surface.triangles = mesh.triangles;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::normal_distribution<float> noise(0.0f, 0.0008f);
  for (int trial = 0; trial < 4; ++trial) {
    const Eigen::Isometry3d truth = boxPose();
    RgbdFrame frame = renderFrame(ring, transformed(mesh.vertices, truth), 1);
    for (float& z : frame.depth) z += noise(random);
    const double turn = 3.0 * uniform(random);
    const Eigen::Isometry3d meant = truth * Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ());
    const Eigen::Vector3d shift = 0.01 * Eigen::Vector3d(uniform(random), uniform(random), uniform(random));
    const Eigen::Isometry3d rough = Eigen::Translation3d(shift) * meant *
                                    Eigen::AngleAxisd(0.1 * uniform(random), Eigen::Vector3d::UnitX());
    const PoseHypothesis found = searchNear(frame, mesh, rough);
    const Points difference = transformed(mesh.vertices, found.pose) - transformed(mesh.vertices, meant);
    EXPECT_LT(difference.rowwise().norm().maxCoeff(), 0.004) << "trial " << trial;
  }
}

TEST(SearchNearPose, KeepsTheRoughPosesTurnAboutTheAxisOfRevolution) { expectTurnOfRoughPose(makeRing()); }

TEST(SearchNearPose, FindsTheAxisAlthoughVerticesAreUneven) { expectTurnOfRoughPose(makeRing(0.9)); }

/// An error of some millimetres of a small body is small compared with the distance scale of the search.
TEST(SearchNearPose, DoesNotPullASmallBodyTowardsARoughPose) {
  BoxBody box = makeBox();
  box.surface.rest_vertices *= 0.15;
  const TriangleMesh mesh{box.surface.rest_vertices, box.surface.triangles};
  Eigen::Isometry3d truth = boxPose();
  truth.translation().z() = 0.35;
  const RgbdFrame frame = renderFrame(box, transformed(mesh.vertices, truth), 1);
  for (const double along : {-0.02, -0.01, 0.01, 0.02}) {
    const Eigen::Isometry3d rough = Eigen::Translation3d(0.0, 0.0, along) * truth;
    const PoseHypothesis found = searchNear(frame, mesh, rough);
    EXPECT_LT((found.pose.translation() - truth.translation()).norm(), 5e-4) << along;
  }
}

/// The noise of a stereo camera grows with the square of the distance.
TEST(SearchNearPose, FindsALargeBodyFarAway) {
  BoxBody box = makeBox();
  box.surface.rest_vertices *= 5.0;
  const TriangleMesh mesh{box.surface.rest_vertices, box.surface.triangles};
  Eigen::Isometry3d truth = boxPose();
  truth.translation() *= 5.0;
  RgbdFrame frame = renderFrame(box, transformed(mesh.vertices, truth), 1);
  std::mt19937 random(4);
  std::normal_distribution<float> noise(0.0f, 0.0025f);
  for (float& z : frame.depth) {
    if (z == 1.2f) z = 5.0f;  // the wall stands behind
    z += z * z * noise(random);
  }
  const Eigen::Isometry3d rough =
      Eigen::Translation3d(0.05, -0.04, 0.05) * truth * Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitY());
  RegistrationConfig config;
  config.pose_std_m = 0.05;
  const PoseHypothesis found = searchNearPose(frame, {mesh, mesh, mesh}, roughPose(rough, config));
  EXPECT_LT(found.cost, 0.25);
  const Points difference = transformed(mesh.vertices, found.pose) - transformed(mesh.vertices, truth);
  EXPECT_LT(difference.rowwise().norm().maxCoeff(), 0.02);
}

TEST(SearchNearPose, FindsNoGoodPoseOnABareWall) {
  const BoxBody box = makeBox(2, 2, 1);
  RgbdFrame frame = renderFrame(box, transformed(box.volume.rest_vertices, boxPose()), 1);
  frame.depth.setTo(1.2f);
  const TriangleMesh mesh{box.surface.rest_vertices, box.surface.triangles};
  EXPECT_GT(searchNear(frame, mesh, boxPose()).cost, 0.5);
}

SearchOutcome acceptedNear(const RgbdFrame& frame, const Eigen::Isometry3d& rough) {
  return searchNearAccepted(frame, makeSearchMeshes(kMesh), roughPose(rough, RegistrationConfig()));
}

/// Rough poses about as far from the truth as their standard deviations.
std::vector<Eigen::Isometry3d> roughPoses() {
  std::vector<Eigen::Isometry3d> poses;
  for (const double sign : {1.0, -1.0})
    poses.push_back(Eigen::Translation3d(0.02 * sign, -0.015, 0.01) * lying() *
                    Eigen::AngleAxisd(0.15 * sign, Eigen::Vector3d(0.3, 0.2, 1.0).normalized()));
  return poses;
}

TEST(SearchNearPose, FindsTheBodyAmongOthers) {
  struct Scene {
    std::vector<Eigen::Isometry3d> boxes;
    double largest_m;  ///< error of a vertex; the hidden half is inferred
  };
  const std::vector<Scene> scenes = {
      {{lying(), lying(0.204)}, 0.006},                    // a twin beside it
      {{lying(), lying(0.0, 0.104), lying(0.21)}, 0.006},  // two
      {{lying(), lying(0.133, 0.0, 0.04)}, 0.006},         // something on a third
      {{lying(), lying(0.1, 0.0, 0.14)}, 0.01},            // half behind something
  };
  for (const Scene& scene : scenes) {
    const RgbdFrame frame = boxesOnTable(scene.boxes);
    for (const Eigen::Isometry3d& rough : roughPoses()) {
      const SearchOutcome outcome = acceptedNear(frame, rough);
      ASSERT_TRUE(outcome.found) << scene.boxes.back().translation().transpose();
      const Points difference =
          transformed(kMesh.vertices, outcome.found->pose) - transformed(kMesh.vertices, lying());
      EXPECT_LT(difference.rowwise().norm().maxCoeff(), scene.largest_m)
          << scene.boxes.back().translation().transpose();
    }
  }
}

/// Seen from the side, the plane in which the box may slide lies across the axes of the camera.
TEST(SearchNearPose, DoesNotStopBetweenTwinsSeenFromTheSide) {
  const Eigen::Isometry3d tilt = Eigen::Translation3d(0.0, 0.0, kTableDepth) *
                                 Eigen::AngleAxisd(0.9, Eigen::Vector3d(1.0, 0.5, 0.0).normalized()) *
                                 Eigen::Translation3d(0.0, 0.0, -kTableDepth);
  const Eigen::Isometry3d truth = tilt * lying();
  for (const double side : {1.0, -1.0}) {
    const RgbdFrame frame = boxesOnTable({truth, tilt * lying(0.0, 0.104 * side)}, 1.2);
    for (const double along : {-0.02, -0.01, 0.01, 0.02}) {
      const SearchOutcome outcome = acceptedNear(frame, truth * Eigen::Translation3d(0.0, along, 0.0));
      ASSERT_TRUE(outcome.found) << side << " " << along;
      const Points difference =
          transformed(kMesh.vertices, outcome.found->pose) - transformed(kMesh.vertices, truth);
      EXPECT_LT(difference.rowwise().norm().maxCoeff(), 0.006) << side << " " << along;
    }
  }
}

TEST(SearchNearPose, TakesNothingElsewhere) {
  for (const double x : {0.22, -0.25})
    EXPECT_FALSE(acceptedNear(boxesOnTable({lying(x)}), lying()).found) << x;
}

}  // namespace
}  // namespace softbody
