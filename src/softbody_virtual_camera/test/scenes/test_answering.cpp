#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "answering/answering_body.h"
#include "answering/moving_hand.h"
#include "fixtures/scene_fixtures.h"

namespace softbody::virtual_camera {
namespace {

const Eigen::Vector3d kSize(0.2, 0.1, 0.04);  // [m]
const HandShape kHand = {{0.02, 0.01, 0.06}, {0.021, 0.051, 0.03}};
const Eigen::Isometry3d kOnTable(Eigen::Translation3d(0.0, 0.0, 0.5 * kSize.z()));

AnsweringBody bodyOnTable() { return {box(kSize), Elasticity(), kOnTable, 9.81, kHand}; }

Eigen::Isometry3d handAt(double x, double z) {
  return Eigen::Translation3d(x, 0.0, z) *
         Eigen::AngleAxisd(3.14159265358979323846, Eigen::Vector3d::UnitX());
}

void run(double duration_s, const Eigen::Isometry3d& goal, bool close, MovingHand* hand,
         AnsweringBody* body) {
  for (double t = 0.0; t < duration_s; t += kAnswerStep_s) {
    hand->step(goal, close, kAnswerStep_s);
    body->step(hand->contact());
  }
}

TEST(AnsweringBody, LiesStillAndTheTableCarriesItsWeight) {
  AnsweringBody body = bodyOnTable();
  MovingHand hand(kHand, handAt(0.0, 0.3));
  const Points start = body.surface();
  run(1.0, handAt(0.0, 0.3), false, &hand, &body);
  EXPECT_LT((body.surface() - start).rowwise().norm().maxCoeff(), 1e-3);
  const double weight = 9.81 * body.material().mass();
  EXPECT_NEAR(body.onTable().force.z(), -weight, 0.02 * weight);
}

TEST(AnsweringBody, AClosedHandTakesItAlongAndAnOpenOneLetsItGo) {
  AnsweringBody body = bodyOnTable();
  MovingHand hand(kHand, handAt(0.0, 0.08));
  run(0.5, handAt(0.0, 0.03), false, &hand, &body);
  run(0.5, handAt(0.0, 0.03), true, &hand, &body);
  ASSERT_TRUE(hand.contact().closed);
  const Points gripped = body.surface();
  run(1.0, handAt(0.02, 0.08), true, &hand, &body);
  const Eigen::Vector3d moved = (body.surface() - gripped).colwise().mean();
  EXPECT_NEAR(moved.x(), 0.02, 2e-3);
  EXPECT_NEAR(moved.z(), 0.05, 5e-3);
  run(1.5, handAt(0.02, 0.3), false, &hand, &body);
  EXPECT_NEAR(body.surface().col(2).minCoeff(), 0.0, 1e-3);
}

TEST(AnsweringBody, FrictionStopsWhatWasPushed) {
  AnsweringBody body = bodyOnTable();
  MovingHand hand(kHand, handAt(0.16, 0.03));
  const double start = body.surface().col(0).mean();
  run(0.5, handAt(0.09, 0.03), false, &hand, &body);
  const double pushed = body.surface().col(0).mean();
  EXPECT_LE(pushed, start + 1e-4);
  run(0.7, handAt(0.16, 0.03), false, &hand, &body);
  const double stopped = body.surface().col(0).mean();
  run(0.5, handAt(0.16, 0.03), false, &hand, &body);
  EXPECT_NEAR(body.surface().col(0).mean(), stopped, 1e-4);
}

TEST(MovingHand, KeepsItsSpeedLimitsAndArrives) {
  MovingHand hand(kHand, handAt(0.0, 0.3));
  const Eigen::Isometry3d goal = handAt(0.1, 0.1) * Eigen::AngleAxisd(1.0, Eigen::Vector3d::UnitZ());
  for (int i = 0; i < 60; ++i) {
    const Eigen::Isometry3d before = hand.contact().T_world_hand;
    hand.step(goal, false, kAnswerStep_s);
    const Eigen::Isometry3d moved = before.inverse() * hand.contact().T_world_hand;
    EXPECT_LE(moved.translation().norm(), 0.2 * kAnswerStep_s + 1e-9);
    EXPECT_LE(Eigen::AngleAxisd(moved.linear()).angle(), 2.0 * kAnswerStep_s + 1e-9);
  }
  EXPECT_TRUE(hand.contact().T_world_hand.isApprox(goal, 1e-9));
}

TEST(Answer, TheSameAgainWhenTimeGoesBack) {
  const Scene scene = makeScene("answer", shippedBody("sponge"), 1);
  const auto bodyAt = [&scene](double t) -> Points { return scene.state(t).vertices.at(0); };
  const Points start = bodyAt(0.0), lifted = bodyAt(4.0);
  EXPECT_GT((lifted - start).rowwise().norm().maxCoeff(), 0.02);
  EXPECT_EQ(bodyAt(0.0), start);
  EXPECT_EQ(bodyAt(4.0), lifted);
}

TEST(Answer, FollowsCommands) {
  const Scene scene = makeScene("answer", shippedBody("sponge"), 1);
  ASSERT_TRUE(scene.hand);
  scene.hand->takeOver();
  const Eigen::Isometry3d goal = handAt(0.05, 0.2);
  scene.hand->moveTo(goal);
  const SceneState state = scene.state(2.0);
  const Eigen::Isometry3d T_world_hand = scene.T_camera_world.inverse() * state.gripper->T_camera_gripper;
  EXPECT_TRUE(T_world_hand.isApprox(goal, 1e-6));
}

}  // namespace
}  // namespace softbody::virtual_camera
