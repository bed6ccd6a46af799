#include <gtest/gtest.h>

#include "agreement/pose_cost.h"
#include "fixtures/synthetic_scene.h"
#include "registration/box_mesh.h"
#include "softbody_common/geometry/rigid_fit.h"

namespace softbody {
namespace {

TEST(PoseCost, IsLowestAtTheTruth) {
  const BoxBody box = makeBox();
  const Eigen::Isometry3d truth = boxPose();
  const RgbdFrame frame = renderFrame(box, transformed(box.volume.rest_vertices, truth), 1);
  const TriangleMesh mesh{box.surface.rest_vertices, box.surface.triangles};
  const double at_truth = PoseCost(frame, mesh)(truth);
  EXPECT_LT(at_truth, 1e-3);
  for (int axis = 0; axis < 3; ++axis) {
    for (double sign : {1.0, -1.0}) {
      const Eigen::Vector3d shift = sign * 0.002 * Eigen::Vector3d::Unit(axis);
      EXPECT_GT(PoseCost(frame, mesh)(Eigen::Translation3d(shift) * truth), at_truth);
    }
  }
}

TEST(PoseCost, IsHighestWhereNothingIsInView) {
  const RgbdFrame frame = renderFrame(kBox, transformed(kMesh.vertices, boxPose()), 1);
  const Eigen::Isometry3d behind(Eigen::Translation3d(0.0, 0.0, -0.5));
  EXPECT_EQ(PoseCost(frame, kMesh)(behind), 1.0);
}

TEST(PoseCost, GivesNoSupportToImplausiblePoses) {
  const RgbdFrame frame = renderFrame(kBox, transformed(kMesh.vertices, boxPose()), 1);
  PoseCost cost(frame, kMesh);
  EXPECT_GT(cost.support(boxPose()), 1000.0);
  for (double aside_m : {0.05, 0.2, 5.0})
    EXPECT_EQ(cost.support(Eigen::Translation3d(aside_m, 0.0, 0.0) * boxPose()), 0.0) << aside_m;
}

}  // namespace
}  // namespace softbody
