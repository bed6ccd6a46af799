#include <gtest/gtest.h>

#include "cage/cage_fitting.h"
#include "fixtures/box_meshes.h"

namespace softbody {
namespace {

/// No move can bring such a point inside.
TEST(FitCage, EndsIfAPointIsOutsideFromTheStart) {
  const TriangleMesh cage = test::boxMesh({0.2, 0.1, 0.04});
  Points points(2, 3);
  points << 0.0, 0.0, 0.0, 1.0, 0.0, 0.0;
  const TriangleMesh fitted = fitCage(cage, points);
  EXPECT_EQ(pointsBeyond(points, fitted), std::vector<Eigen::Index>{1});
}

}  // namespace
}  // namespace softbody
