#include "dynamics/occluded_piece_damping.h"

#include <gtest/gtest.h>

#include "fixtures/test_meshes.h"

namespace softbody {
namespace {

using testing::randomPoints;

Target targetIn(int tet) {
  Target target;
  target.place = {tet, Eigen::Vector4d::Constant(0.25)};
  return target;
}

TEST(OccludedPieceDamping, StopsAPieceWhileOthersAreObserved) {
  std::mt19937 random(3);
  const TetTopology topology = testing::twoBoxes({2, 2, 2}, {0.1, 0.1, 0.1});
  const Eigen::Index count = topology.rest_vertices.rows() / 2;
  const Points before = randomPoints(2 * count, 1.0, &random);
  OccludedPieceDamping pieces(topology);
  Points velocities = before;
  pieces.apply({targetIn(0)}, 0.1, &velocities);
  EXPECT_EQ(velocities.topRows(count), before.topRows(count));
  EXPECT_TRUE(velocities.bottomRows(count).isApprox(0.5 * before.bottomRows(count), 1e-12));
}

TEST(OccludedPieceDamping, ChangesNothingWhenNoPieceOrEveryPieceIsObserved) {
  std::mt19937 random(3);
  const TetTopology topology = testing::twoBoxes({2, 2, 2}, {0.1, 0.1, 0.1});
  const Points before = randomPoints(topology.rest_vertices.rows(), 1.0, &random);
  OccludedPieceDamping pieces(topology);
  Points velocities = before;
  pieces.apply({}, 0.1, &velocities);
  const int last = static_cast<int>(topology.tets.rows()) - 1;
  pieces.apply({targetIn(0), targetIn(last)}, 0.1, &velocities);
  EXPECT_EQ(velocities, before);
}

TEST(OccludedPieceDamping, ChangesNothingOfAnUncutBody) {
  const TetTopology topology = testing::boxTopology({2, 2, 2}, {0.1, 0.1, 0.1});
  Points velocities = Points::Ones(topology.rest_vertices.rows(), 3);
  OccludedPieceDamping(topology).apply({targetIn(0)}, 0.1, &velocities);
  EXPECT_EQ(velocities, Points::Ones(velocities.rows(), 3));
}

}  // namespace
}  // namespace softbody
