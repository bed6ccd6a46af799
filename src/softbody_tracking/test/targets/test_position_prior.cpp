#include <gtest/gtest.h>

#include "fixtures/synthetic_scene.h"
#include "softbody_common/geometry/tet_geometry.h"
#include "targets/position_prior.h"

namespace softbody {
namespace {

TEST(PositionPrior, KeepsEachVertexOfThePieceAndNoOther) {
  const BoxBody body = cutBox(makeBox());
  const TetTopology& volume = body.volume;
  const std::vector<std::vector<int>> pieces = verticesOfPieces(volume.tets, volume.rest_vertices.rows());
  ASSERT_EQ(pieces.size(), 2u);
  const Points positions = volume.rest_vertices.array() + 0.1;
  for (const std::vector<int>& piece : pieces) {
    std::vector<Target> targets;
    PositionPrior(volume).addTargets(piece, positions, PositionPrior::kPriorWeight, &targets);
    ASSERT_EQ(targets.size(), piece.size());
    for (std::size_t i = 0; i < piece.size(); ++i) {
      const Eigen::Vector3d rest = positionOf(targets[i].place, volume.rest_vertices, volume.tets);
      EXPECT_EQ(rest.transpose(), volume.rest_vertices.row(piece[i]));
      EXPECT_EQ(targets[i].position.transpose(), positions.row(piece[i]));
      EXPECT_TRUE(targets[i].normal.isZero());
      EXPECT_EQ(targets[i].weight, PositionPrior::kPriorWeight);
      EXPECT_EQ(targets[i].kind, TargetKind::kPrior);
    }
  }
}

}  // namespace
}  // namespace softbody
