#include <gtest/gtest.h>

#include <random>

#include "core/body_finder.h"
#include "core/registration.h"
#include "softbody_common/rigid_fit.h"
#include "synthetic_scene.h"

namespace softbody {
namespace {

TEST(Registration, FindsTheBoxFromRoughPoses) {
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
    const RegistrationResult found = registerBody(frame, mesh, mesh, rough, RegistrationConfig());
    const Points difference = transformed(mesh.vertices, found.pose) - transformed(mesh.vertices, truth);
    EXPECT_LT(difference.rowwise().norm().maxCoeff(), 0.002) << "trial " << trial << ", cost " << found.cost;
  }
}

TEST(Registration, ACoarseMeshServesForTheSearch) {
  const BoxBody box = makeBox(40, 20, 8);
  const TriangleMesh mesh{box.surface.rest_vertices, box.surface.triangles};
  const TriangleMesh coarse = clustered(mesh, 0.012);
  ASSERT_LT(4 * coarse.triangles.rows(), mesh.triangles.rows());
  const Eigen::Isometry3d truth = boxPose();
  const RgbdFrame frame = renderFrame(box, transformed(mesh.vertices, truth), 1);
  const Eigen::Isometry3d rough = Eigen::Translation3d(0.01, -0.015, 0.01) * truth *
                                  Eigen::AngleAxisd(0.2, Eigen::Vector3d(1, 2, -1).normalized());
  const RegistrationResult found = registerBody(frame, mesh, coarse, rough, RegistrationConfig());
  const Points difference = transformed(mesh.vertices, found.pose) - transformed(mesh.vertices, truth);
  EXPECT_LT(difference.rowwise().norm().maxCoeff(), 0.002) << found.cost;
}

TEST(Registration, CostIsLowestAtTheTruth) {
  const BoxBody box = makeBox();
  const Eigen::Isometry3d truth = boxPose();
  const RgbdFrame frame = renderFrame(box, transformed(box.volume.rest_vertices, truth), 1);
  const TriangleMesh mesh{box.surface.rest_vertices, box.surface.triangles};
  const double at_truth = poseCost(frame, mesh, truth, 0.02);
  EXPECT_LT(at_truth, 1e-3);
  for (int axis = 0; axis < 3; ++axis) {
    for (double sign : {1.0, -1.0}) {
      const Eigen::Vector3d shift = sign * 0.002 * Eigen::Vector3d::Unit(axis);
      EXPECT_GT(poseCost(frame, mesh, Eigen::Translation3d(shift) * truth, 0.02), at_truth);
    }
  }
}

TEST(Registration, NothingInViewCostsAll) {
  const BoxBody box = makeBox(2, 2, 1);
  RgbdFrame frame = renderFrame(box, transformed(box.volume.rest_vertices, boxPose()), 1);
  const TriangleMesh mesh{box.surface.rest_vertices, box.surface.triangles};
  const Eigen::Isometry3d behind(Eigen::Translation3d(0.0, 0.0, -0.5));
  EXPECT_EQ(poseCost(frame, mesh, behind, 0.02), 1.0);
  frame.depth.setTo(1.2f);
  EXPECT_GT(registerBody(frame, mesh, mesh, boxPose(), RegistrationConfig()).cost, 0.5)
      << "only the wall is there";
}

}  // namespace
}  // namespace softbody
