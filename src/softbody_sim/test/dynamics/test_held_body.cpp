#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bench/peers/held_body.h"
#include "fixtures/test_meshes.h"

namespace softbody::bench {
namespace {

constexpr double kLength_m = 0.2, kCurvature = 5.0;
constexpr int kFrames = 4;

/// A quarter of each half is an end.
TetTopology thickBody() { return testing::boxTopology({8, 2, 2}, {kLength_m, 0.05, 0.1}); }

// Beside the hands, a body that is bent grows thinner where it is longer. A formula keeps its thickness.
TEST(HeldBody, GrowsThinnerWhereItIsLonger) {
  const TetTopology body = thickBody();
  const Points& rest = body.rest_vertices;
  const Points shape = heldShapes(body, kCurvature, kFrames).back();
  const auto width = [&](double height) {
    double low = 1.0, high = -1.0;
    for (Eigen::Index v = 0; v < rest.rows(); ++v) {
      if (std::abs(rest(v, 0) - 0.5 * kLength_m) > 1e-6 || std::abs(rest(v, 2) - height) > 1e-6) continue;
      low = std::min(low, shape(v, 1));
      high = std::max(high, shape(v, 1));
    }
    return high - low;
  };
  EXPECT_LT(width(0.0), 0.049);  // the long side
  EXPECT_GT(width(0.1), 0.051);  // the short side
}

TEST(HeldBody, HandsMoveTheEndsRigidlyToTheBentAxis) {
  const TetTopology body = thickBody();
  const Points shape = heldShapes(body, kCurvature, kFrames).back();
  const Eigen::RowVector3d middle = body.rest_vertices.colwise().mean();
  for (const double side : {-1.0, 1.0}) {
    const double angle = kCurvature * side * 0.75 * 0.5 * kLength_m;
    Eigen::Index first = -1;
    for (Eigen::Index v = 0; v < shape.rows(); ++v) {
      if (side * (body.rest_vertices(v, 0) - middle.x()) < 0.74 * 0.5 * kLength_m) continue;
      if (first < 0) first = v;
      const Eigen::Vector3d before = (body.rest_vertices.row(v) - body.rest_vertices.row(first)).transpose();
      const Eigen::Vector3d after = Eigen::AngleAxisd(-angle, Eigen::Vector3d::UnitY()) * before;
      EXPECT_LT((shape.row(v) - shape.row(first) - after.transpose()).norm(), 1e-5);
    }
  }
}

// Shapes in balance do not depend on the way to them.
TEST(HeldBody, IsInBalance) {
  const TetTopology body = thickBody();
  const Points slow = heldShapes(body, kCurvature, kFrames).back(),
               fast = heldShapes(body, kCurvature, 2).back();
  EXPECT_LT((slow - fast).rowwise().norm().maxCoeff(), 3e-6);
}

}  // namespace
}  // namespace softbody::bench
