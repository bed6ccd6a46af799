#include <gtest/gtest.h>

#include "fixtures/synthetic_scene.h"
#include "prediction/rigid_prediction.h"
#include "softbody_common/rigid_fit.h"

namespace softbody {
namespace {

RigidPrediction predictionOf(const TetTopology& volume) {
  return {volume.rest_vertices, verticesOfPieces(volume.tets, volume.rest_vertices.rows())};
}

/// A screw motion: turns about a fixed axis and shifts along it.
Points screwed(const Points& rest, double angle) {
  return transformed(rest, Eigen::Translation3d(0.0, 0.0, 0.02 * angle) *
                               Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()) *
                               Eigen::Isometry3d::Identity());
}

TEST(RigidPrediction, GoesOnAsTheBodyMoved) {
  const TetTopology volume = makeBox().volume;
  const Points& rest = volume.rest_vertices;
  RigidPrediction prediction = predictionOf(volume);
  prediction.observe(screwed(rest, 0.1), 1000);
  EXPECT_EQ(prediction.at(2000), screwed(rest, 0.1)) << "one state is no motion";
  prediction.observe(screwed(rest, 0.2), 2000);
  EXPECT_LT((prediction.at(3000) - screwed(rest, 0.3)).norm(), 1e-9);
  EXPECT_LT((prediction.at(3500) - screwed(rest, 0.35)).norm(), 1e-9);
}

TEST(RigidPrediction, SaysNothingAfterAGapOrAJumpBack) {
  const TetTopology volume = makeBox().volume;
  const Points& rest = volume.rest_vertices;
  RigidPrediction prediction = predictionOf(volume);
  prediction.observe(screwed(rest, 0.1), 1000);
  prediction.observe(screwed(rest, 0.2), 2000);
  EXPECT_EQ(prediction.at(20000), screwed(rest, 0.2));
  prediction.observe(screwed(rest, 0.0), 500);
  EXPECT_EQ(prediction.at(1000), screwed(rest, 0.0));
}

TEST(RigidPrediction, PiecesGoTheirOwnWay) {
  const TetTopology box = makeBox().volume;
  const Eigen::Index count = box.rest_vertices.rows();
  TetTopology both = box;
  both.rest_vertices.conservativeResize(2 * count, 3);
  both.rest_vertices.bottomRows(count) = box.rest_vertices;
  both.tets.conservativeResize(2 * box.tets.rows(), 4);
  both.tets.bottomRows(box.tets.rows()) = box.tets.array() + static_cast<int>(count);
  const auto placed = [&](double first, double second) {
    Points vertices(2 * count, 3);
    vertices << screwed(box.rest_vertices, first), screwed(box.rest_vertices, second);
    return vertices;
  };
  RigidPrediction prediction = predictionOf(both);
  prediction.observe(placed(0.1, 0.3), 1000);
  prediction.observe(placed(0.2, 0.1), 2000);
  EXPECT_LT((prediction.at(3000) - placed(0.3, -0.1)).norm(), 1e-9);
  EXPECT_LT((prediction.at(3000, {false, true}) - placed(0.2, -0.1)).norm(), 1e-9) << "it must stay";
}

}  // namespace
}  // namespace softbody
