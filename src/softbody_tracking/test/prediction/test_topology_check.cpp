#include <gtest/gtest.h>

#include <numeric>

#include "prediction/topology_check.h"

namespace softbody {
namespace {

/// A body of some vertices, each its own parent.
TetTopology bodyOf(const Points& vertices) {
  TetTopology body;
  body.rest_vertices = vertices;
  body.vertex_parents.resize(static_cast<std::size_t>(vertices.rows()));
  std::iota(body.vertex_parents.begin(), body.vertex_parents.end(), 0);
  return body;
}

TEST(TopologyCheck, ACutBodyMayBeAnEdit) {
  const TetTopology whole = bodyOf(Points::Random(20, 3));
  TetTopology cut = whole;
  cut.rest_vertices.conservativeResize(30, 3);
  cut.rest_vertices.bottomRows(5) = Points::Random(5, 3);
  cut.rest_vertices.middleRows(20, 5) = whole.rest_vertices.topRows(5);
  for (int copied = 0; copied < 5; ++copied) cut.vertex_parents.push_back(copied);
  cut.vertex_parents.insert(cut.vertex_parents.end(), 5, -1);
  EXPECT_TRUE(mayBeEditOf(whole, cut));
  EXPECT_TRUE(mayBeEditOf(cut, whole)) << "an undo";
  cut.rest_vertices.row(3) += Eigen::RowVector3d(0.001, 0.0, 0.0);
  EXPECT_TRUE(mayBeEditOf(whole, cut)) << "a vertex at the cut may move";
}

TEST(TopologyCheck, AnEditMayRoundAsMessagesDo) {
  const TetTopology body = bodyOf(Points::Random(20, 3));
  TetTopology rounded = body;
  rounded.rest_vertices = body.rest_vertices.cast<float>().cast<double>();
  ASSERT_NE(rounded.rest_vertices, body.rest_vertices);
  EXPECT_TRUE(mayBeEditOf(body, rounded));
  EXPECT_TRUE(mayBeEditOf(rounded, body));
}

TEST(TopologyCheck, AnotherBodyIsNoEdit) {
  const TetTopology body = bodyOf(Points::Random(20, 3));
  EXPECT_FALSE(mayBeEditOf(body, bodyOf(Points::Random(20, 3))));
  EXPECT_FALSE(mayBeEditOf(body, bodyOf(Points::Random(5, 3)))) << "with fewer vertices";
  EXPECT_FALSE(mayBeEditOf(body, bodyOf(1.01 * body.rest_vertices))) << "of another size";
}

TEST(TopologyCheck, WithoutParentsNothingSpeaksAgainstAnEdit) {
  TetTopology body = bodyOf(Points::Random(20, 3)), other = bodyOf(Points::Random(20, 3));
  other.vertex_parents.clear();
  EXPECT_TRUE(mayBeEditOf(body, other));
  EXPECT_TRUE(mayBeEditOf(other, body));
}

}  // namespace
}  // namespace softbody
