#include <gtest/gtest.h>

#include "fixtures/test_meshes.h"
#include "softbody_sim/dynamics/prediction.h"

namespace softbody {
namespace {

constexpr Nanoseconds kPredictedStep = 33333333;
constexpr double kTimeStep = 1e-9 * kPredictedStep;

/// A sponge that is held at one end and swings.
class Predictions : public ::testing::Test {
 protected:
  Predictions() : simulator_(topology_, {2e4, 0.2, 30.0, 0.1}, configOf()) {
    for (int v = 0; v < topology_.rest_vertices.rows(); ++v) {
      if (topology_.rest_vertices(v, 0) < 1e-9)
        surroundings_.pins.push_back({v, topology_.rest_vertices.row(v)});
    }
    TargetSet reset;
    reset.reset = true;
    simulator_.step(reset, 0);
    for (int frame = 1; frame <= 5; ++frame) simulator_.step({}, frame * kPredictedStep, surroundings_);
  }
  static SimulatorConfig configOf() {
    SimulatorConfig config;
    config.gravity = {0.0, 0.0, -9.81};
    return config;
  }
  MotionPlan planOf(const Eigen::Vector3d& shift) const {
    Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
    motion.translation() = shift;
    return {surroundings_, std::vector<RigidPath>(surroundings_.pins.size(), {{0.2}, {motion}}), {}};
  }

  TetTopology topology_ = testing::sponge();
  Simulator simulator_;
  Surroundings surroundings_;
};

TEST_F(Predictions, AreWhatTheSimulatorDoesAndLeaveItAlone) {
  const Points before = simulator_.state().vertices;
  const auto predicted = predict(simulator_, {planOf({0.0, 0.0, 0.03})}, {0.11, 0.32}, kTimeStep, 1);
  EXPECT_EQ(simulator_.state().vertices, before);
  ASSERT_EQ(predicted.at(0).size(), 2U);
  for (int step = 1; step <= 10; ++step) {
    Surroundings now = surroundings_;
    for (Pin& pin : now.pins) pin.position.z() += 0.03 * std::min(1.0, step * kTimeStep / 0.2);
    simulator_.step({}, (5 + step) * kPredictedStep, now);
    if (step != 4 && step != 10) continue;  // the first steps that reach 0.11 and 0.32 s
    const PredictedState& state = predicted[0][step == 4 ? 0 : 1];
    EXPECT_NEAR(state.time_s, step * kTimeStep, 1e-9);
    EXPECT_LT((state.vertices - simulator_.state().vertices).rowwise().norm().maxCoeff(), 1e-5);
    ASSERT_EQ(state.reactions.pins.size(), surroundings_.pins.size());
    EXPECT_LT((state.reactions.pins[0].force - simulator_.reactions().pins[0].force).norm(), 1e-3);
  }
}

TEST_F(Predictions, DependNeitherOnThreadsNorOnTheOtherPlans) {
  std::vector<MotionPlan> plans;
  for (int k = 0; k < 6; ++k) plans.push_back(planOf({0.0, 0.0, 0.005 * k}));
  const auto alone = predict(simulator_, {plans[4]}, {0.5}, kTimeStep, 1);
  for (const int threads : {1, 3}) {
    const auto all = predict(simulator_, plans, {0.5}, kTimeStep, threads);
    EXPECT_EQ(all.at(4).at(0).vertices, alone.at(0).at(0).vertices);
    EXPECT_NE(all.at(3).at(0).vertices, alone.at(0).at(0).vertices);
  }
}

TEST(RigidPath, IsLinearAndStaysAtItsEnd) {
  Eigen::Isometry3d motion(Eigen::Translation3d(0.0, 0.02, 0.0) *
                           Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitX()));
  const RigidPath path{{1.0, 2.0}, {motion, Eigen::Isometry3d::Identity()}};
  EXPECT_TRUE(path.at(0.0).isApprox(Eigen::Isometry3d::Identity()));
  EXPECT_NEAR(path.at(0.5).translation().y(), 0.01, 1e-12);
  EXPECT_NEAR(Eigen::AngleAxisd(path.at(1.5).linear()).angle(), 0.2, 1e-12);
  EXPECT_TRUE(path.at(1.0).isApprox(motion));
  EXPECT_TRUE(path.at(9.0).isApprox(Eigen::Isometry3d::Identity()));
}

}  // namespace
}  // namespace softbody
