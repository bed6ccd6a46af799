#include "agreement/confinement.h"

#include <gtest/gtest.h>

#include "agreement/boxes_on_table.h"
#include "softbody_common/geometry/rigid_fit.h"

namespace softbody {
namespace {

double confinementIn(const RgbdFrame& frame, const Eigen::Isometry3d& pose = lying(),
                     const TriangleMesh& mesh = kMesh) {
  return confinement(frame, mesh, pose);
}

TEST(Confinement, IsOneForABodyThatStandsFree) { EXPECT_GT(confinementIn(boxesOnTable({lying()})), 0.9); }

TEST(Confinement, IsAHalfBesideANeighbourThatTouches) {
  for (const auto& [x, y] : {std::pair(0.204, 0.0), std::pair(0.0, 0.104), std::pair(-0.2, 0.0)})
    EXPECT_NEAR(confinementIn(boxesOnTable({lying(), lying(x, y)})), 0.55, 0.1) << x << " " << y;
}

TEST(Confinement, IsAHalfIfHalfIsHidden) {
  for (const double before : {0.04, 0.14})
    EXPECT_NEAR(confinementIn(boxesOnTable({lying(), lying(0.1, 0.0, before)})), 0.5, 0.1);
}

TEST(Confinement, IsZeroWhereTheMeshMaySlide) {
  const Eigen::Isometry3d sunk = Eigen::Translation3d(0.0, 0.25, 0.04) * lying();
  EXPECT_LT(confinementIn(boxesOnTable({lying()}), sunk), 0.1);
  // Between two others, as long as they are.
  EXPECT_LT(confinementIn(boxesOnTable({lying(0.1), lying(-0.1)})), 0.1);
  const Eigen::Isometry3d outside(Eigen::Translation3d(0.0, 0.0, -1.0));
  EXPECT_EQ(confinementIn(boxesOnTable({lying()}), outside), 0.0);
}

TEST(Confinement, WorksForABodyThinnerThanTheDistanceScale) {
  BoxBody thin = kBox;
  thin.surface.rest_vertices.col(2) *= 0.1;
  const TriangleMesh mesh{thin.surface.rest_vertices, thin.surface.triangles};
  const Eigen::Isometry3d pose(Eigen::Translation3d(0.0, 0.0, kTableDepth - 0.002));
  RgbdFrame frame = renderFrame(thin, transformed(mesh.vertices, pose), 1);
  frame.depth.setTo(kTableDepth, frame.depth > 1.0f);
  EXPECT_GT(confinementIn(frame, pose, mesh), 0.9);
}

}  // namespace
}  // namespace softbody
