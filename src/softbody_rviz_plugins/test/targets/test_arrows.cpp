#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "shapes.h"
#include "targets/arrows.h"

namespace softbody {
namespace {

TEST(Arrows, pointFromTheBodyToTheMeasurement) {
  const TetTopology cube = cubeOfTets();
  Target target;
  target.place = {0, {0.25, 0.25, 0.25, 0.25}};
  target.position = {2, 3, 4};
  const Arrow arrow = arrowOf(target, cube.rest_vertices, cube.tets, 1.0);
  const Eigen::Vector3d center =
      cube.rest_vertices(cube.tets.row(0).transpose(), Eigen::all).colwise().mean();
  EXPECT_LT((arrow.from - center).norm(), 1e-12);
  EXPECT_LT((arrow.to - target.position).norm(), 1e-12);
  const Arrow longer = arrowOf(target, cube.rest_vertices, cube.tets, 3.0);
  EXPECT_LT((longer.to - longer.from - 3.0 * (arrow.to - arrow.from)).norm(), 1e-12);
}

TEST(Arrows, aTargetWithANormalPullsAlongItOnly) {
  const TetTopology cube = cubeOfTets();
  Target target;
  target.place = {1, {1, 0, 0, 0}};
  target.position = {0.3, 0.4, -0.2};
  target.normal = {0, 0, 1};
  const Arrow arrow = arrowOf(target, cube.rest_vertices, cube.tets, 1.0);
  EXPECT_LT((arrow.to - arrow.from - Eigen::Vector3d(0, 0, -0.2)).norm(), 1e-12);
}

TEST(Arrows, areDrawnBetweenTheirEnds) {
  const Arrow arrow{{1, 2, 3}, {1.5, 2, 4}};
  const double width = 0.01;
  const auto vertices = placeArrows({arrow}, 1, width);
  ASSERT_EQ(vertices.size(), static_cast<std::size_t>(kVerticesPerArrow));
  const Eigen::Vector3d direction = (arrow.to - arrow.from).normalized();
  for (const PlacedVertex& vertex : vertices) {
    const Eigen::Vector3d offset = vertex.position.cast<double>() - arrow.from;
    const double along = offset.dot(direction);
    EXPECT_GE(along, -1e-6);
    EXPECT_LE(along, (arrow.to - arrow.from).norm() + 1e-6);
    EXPECT_LE((offset - along * direction).norm(), 2.0 * width);
  }
  EXPECT_LT((vertices.back().position.cast<double>() - arrow.to).norm(), 1e-6) << "the tip";
}

TEST(Arrows, unusedRoomHasNoSize) {
  const auto vertices = placeArrows({{{0, 0, 0}, {1, 0, 0}}, {{5, 5, 5}, {5, 5, 5}}}, 4, 0.01);
  ASSERT_EQ(vertices.size(), 4u * kVerticesPerArrow);
  for (int a = 1; a < 4; ++a) {
    for (int v = 1; v < kVerticesPerArrow; ++v)
      EXPECT_EQ(vertices[a * kVerticesPerArrow + v].position, vertices[a * kVerticesPerArrow].position);
  }
  for (const PlacedVertex& vertex : vertices)
    EXPECT_TRUE(vertex.position.allFinite() && vertex.normal.allFinite());
}

TEST(Arrows, layoutNamesOnlyItsVertices) {
  const MeshLayout layout = layoutOfArrows(3);
  for (const std::uint32_t index : layout.parts[0]) EXPECT_LT(index, layout.vertices.size());
}

}  // namespace
}  // namespace softbody
