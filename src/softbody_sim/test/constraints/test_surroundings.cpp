#include <gtest/gtest.h>

#include <algorithm>

#include <string>

#include "fixtures/test_meshes.h"
#include "softbody_sim/dynamics/simulator.h"

namespace softbody {
namespace {

using testing::sponge;

constexpr Nanoseconds kFrame = 33333333;
constexpr double kGravity = 9.81;
const double kWeight = 30.0 * 0.2 * 0.1 * 0.03 * kGravity;  // [N]

/// Pins and contact with both solvers.
class UnderBothSolvers : public ::testing::TestWithParam<SolverKind> {
 protected:
  void SetUp() override {
    config_.solver = GetParam();
    config_.iterations = 1000;
    config_.tolerance = 1e-6;
    config_.gravity = {0.0, 0.0, -kGravity};
    material_.damping = 0.5;
  }
  static void place(Simulator* simulator) {
    TargetSet reset;
    reset.reset = true;
    simulator->step(reset, 0);
  }
  /// Pins at the displaced rest positions that a condition selects.
  template <typename Condition>
  std::vector<Pin> pinsWhere(Condition condition, const Eigen::Vector3d& move = Eigen::Vector3d::Zero()) {
    std::vector<Pin> pins;
    for (int v = 0; v < topology_.rest_vertices.rows(); ++v) {
      const Eigen::Vector3d rest = topology_.rest_vertices.row(v);
      if (condition(rest)) pins.push_back({v, rest + move});
    }
    return pins;
  }
  static Wrench sumAboutOrigin(const Simulator& simulator, const Surroundings& surroundings) {
    Wrench sum;
    const auto add = [&sum](const Wrench& wrench, const Eigen::Vector3d& place) {
      sum.force += wrench.force;
      sum.torque += wrench.torque + place.cross(wrench.force);
    };
    for (std::size_t k = 0; k < surroundings.pins.size(); ++k)
      add(simulator.reactions().pins[k], surroundings.pins[k].position);
    for (std::size_t k = 0; k < surroundings.obstacles.size(); ++k)
      add(simulator.reactions().obstacles[k], surroundings.obstacles[k].pose.translation());
    return sum;
  }
  double deepest(const Obstacle& obstacle, const Points& vertices) const {
    double depth = 0.0;
    for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
      const Eigen::Vector3d point = obstacle.pose.inverse() * Eigen::Vector3d(vertices.row(v));
      depth = std::max(depth, -distanceTo(obstacle, point).distance);
    }
    return depth;
  }

  TetTopology topology_ = sponge();
  Material material_;
  SimulatorConfig config_;
};

TEST_P(UnderBothSolvers, PinsCarryAHangingBody) {
  Simulator simulator(topology_, material_, config_);
  place(&simulator);
  Surroundings surroundings;
  surroundings.pins = pinsWhere([](const Eigen::Vector3d& p) { return p.x() < 1e-9; });
  simulator.settle({}, surroundings);
  EXPECT_TRUE(simulator.report().converged);
  const Wrench sum = sumAboutOrigin(simulator, surroundings);
  EXPECT_LT((sum.force - Eigen::Vector3d(0.0, 0.0, -kWeight)).norm(), 1e-5 * kWeight);
  const Points& x = simulator.state().vertices;
  for (const Pin& pin : surroundings.pins)
    EXPECT_LT((Eigen::Vector3d(x.row(pin.vertex)) - pin.position).norm(), 1e-6);
  EXPECT_LT(x.col(2).minCoeff(), -0.001);
}

TEST_P(UnderBothSolvers, DynamicsComeToRestInStaticEquilibrium) {
  Surroundings surroundings;
  surroundings.pins = pinsWhere([](const Eigen::Vector3d& p) { return p.x() < 1e-9; });
  Simulator settled(topology_, material_, config_), stepped(topology_, material_, config_);
  place(&settled);
  place(&stepped);
  settled.settle({}, surroundings);
  for (int frame = 1; frame <= 200; ++frame) stepped.step({}, frame * kFrame, surroundings);
  EXPECT_LT((settled.state().vertices - stepped.state().vertices).norm(), 1e-6);
}

TEST_P(UnderBothSolvers, TheGroundCarriesABodyThatLiesOnIt) {
  Simulator simulator(topology_, material_, config_);
  place(&simulator);
  Surroundings surroundings;
  surroundings.obstacles = {Obstacle::plane()};
  surroundings.obstacles[0].pose = Eigen::Translation3d(0.3, 0.0, -0.002);
  for (int frame = 1; frame <= 150; ++frame) simulator.step({}, frame * kFrame, surroundings);
  const Wrench sum = sumAboutOrigin(simulator, surroundings);
  EXPECT_LT((sum.force - Eigen::Vector3d(0.0, 0.0, -kWeight)).norm(), 1e-3 * kWeight);
  const Eigen::Vector3d center(0.1, 0.05, 0.0);
  EXPECT_LT((sum.torque - center.cross(sum.force)).norm(), 2e-3 * kWeight * center.norm());
  EXPECT_LT(deepest(surroundings.obstacles[0], simulator.state().vertices), 1e-4);
}

TEST_P(UnderBothSolvers, MovingPinsMoveTheBody) {
  config_.gravity.setZero();
  Simulator simulator(topology_, material_, config_);
  place(&simulator);
  const auto held = [](const Eigen::Vector3d& p) { return p.x() < 0.03; };
  Surroundings surroundings;
  for (int frame = 1; frame <= 60; ++frame) {
    surroundings.pins = pinsWhere(held, {0.0, 0.0, 0.033 * std::min(frame, 10)});  // 1 m/s, then rest
    simulator.step({}, frame * kFrame, surroundings);
    for (const Pin& pin : surroundings.pins) {
      EXPECT_LT((Eigen::Vector3d(simulator.state().vertices.row(pin.vertex)) - pin.position).norm(), 1e-5);
    }
  }
  const Eigen::RowVector3d move = (simulator.state().vertices - topology_.rest_vertices).colwise().mean();
  EXPECT_LT((move - Eigen::RowVector3d(0.0, 0.0, 0.33)).norm(), 1e-3);
}

TEST_P(UnderBothSolvers, AToolAtOneMetrePerSecondDoesNotPassThrough) {
  config_.gravity.setZero();
  for (const Obstacle& shape :
       {Obstacle::sphere(0.01), Obstacle::capsule(0.006, 0.04), Obstacle::box({0.02, 0.02, 0.01}, 0.002)}) {
    Simulator simulator(topology_, material_, config_);
    place(&simulator);
    Surroundings surroundings;
    surroundings.obstacles = {shape};
    for (int frame = 0; frame <= 12; ++frame) {
      const double height = 0.08 - 0.033 * frame;
      surroundings.obstacles[0].pose =
          Eigen::Translation3d(0.1, 0.05, height) * Eigen::AngleAxisd(1.57, Eigen::Vector3d::UnitX());
      simulator.step({}, (frame + 1) * kFrame, surroundings);
      EXPECT_LT(deepest(surroundings.obstacles[0], simulator.state().vertices), 0.002) << frame;
    }
    // The free body is pushed 0.4 m. It may tip over the tool; then its middle is behind by at most half its
    // length.
    EXPECT_LT(simulator.state().vertices.col(2).mean(), 0.08 - 0.033 * 12 + 0.1);
  }
}

/// On an incline just flatter and just steeper than the angle of friction. The plane stays level, gravity
/// turns.
TEST_P(UnderBothSolvers, ABlockSlidesAtTheAngleOfFriction) {
  constexpr double kFriction = 0.5;
  constexpr int kFrames = 30;
  if (GetParam() == SolverKind::kFem) config_.iterations = 50;
  topology_ = testing::boxTopology({3, 3, 2}, {0.06, 0.06, 0.04});
  material_ = {1e6, 0.3, 1000.0, 0.0};
  for (const double slope : {0.98 * kFriction, 1.02 * kFriction}) {
    const double angle = std::atan(slope), along = kGravity * std::sin(angle),
                 across = kGravity * std::cos(angle);
    config_.gravity = {along, 0.0, -across};
    Simulator simulator(topology_, material_, config_);
    place(&simulator);
    Surroundings surroundings;
    surroundings.obstacles = {Obstacle::plane()};
    surroundings.obstacles[0].friction = kFriction;
    for (int frame = 1; frame <= kFrames; ++frame) simulator.step({}, frame * kFrame, surroundings);
    const double moved = (simulator.state().vertices - topology_.rest_vertices).col(0).mean();
    const double time_s = 1e-9 * kFrames * kFrame,
                 slides = 0.5 * (along - kFriction * across) * time_s * time_s;
    if (slope < kFriction)
      EXPECT_LT(moved, 1e-4);
    else
      EXPECT_NEAR(moved, slides, 0.2 * slides);
    const double friction = std::min(along / across, kFriction);
    const Eigen::Vector3d force = simulator.reactions().obstacles[0].force;
    EXPECT_NEAR(force.x(), -friction * force.z(), 0.01 * -force.z());
  }
}

TEST_P(UnderBothSolvers, ATableThatJumpsMovesTheBody) {
  config_.gravity.setZero();
  Simulator simulator(topology_, material_, config_);
  place(&simulator);
  Surroundings surroundings;
  surroundings.obstacles = {Obstacle::box({0.4, 0.4, 0.01}, 0.0)};
  surroundings.obstacles[0].pose = Eigen::Translation3d(0.1, 0.05, -0.5);
  simulator.step({}, kFrame, surroundings);
  surroundings.obstacles[0].pose = Eigen::Translation3d(0.1, 0.05, 0.5);  // at 30 m/s
  simulator.step({}, 2 * kFrame, surroundings);
  EXPECT_GT(simulator.state().vertices.col(2).minCoeff(), 0.504);
}

TEST_P(UnderBothSolvers, ToolAndPinsBalanceAtRest) {
  Simulator simulator(topology_, material_, config_);
  place(&simulator);
  Surroundings surroundings;
  surroundings.pins = pinsWhere([](const Eigen::Vector3d& p) { return p.x() < 1e-9 || p.x() > 0.2 - 1e-9; });
  surroundings.obstacles = {Obstacle::sphere(0.02)};
  for (int frame = 1; frame <= 100; ++frame) {
    surroundings.obstacles[0].pose = Eigen::Translation3d(0.1, 0.05, 0.06 - 0.001 * std::min(frame, 25));
    simulator.step({}, frame * kFrame, surroundings);
  }
  EXPECT_GT(simulator.reactions().obstacles[0].force.z(), 0.1);
  const Wrench sum = sumAboutOrigin(simulator, surroundings);
  EXPECT_LT((sum.force - Eigen::Vector3d(0.0, 0.0, -kWeight)).norm(), 1e-3);
  EXPECT_LT((sum.torque - Eigen::Vector3d(0.1, 0.05, 0.0).cross(Eigen::Vector3d(0.0, 0.0, -kWeight))).norm(),
            1e-3);
}

TEST_P(UnderBothSolvers, UnobservedStepsKeepTheTargetsAndLoseConfidence) {
  config_.gravity.setZero();
  Simulator simulator(topology_, material_, config_);
  place(&simulator);
  TargetSet targets;
  Points goal = topology_.rest_vertices;
  goal.col(2) += 2.0 * goal.col(0).cwiseAbs2();
  targets.targets = testing::vertexTargets(topology_, goal);
  for (int frame = 1; frame <= 60; ++frame) simulator.step(targets, frame * kFrame);
  const MeshState seen = simulator.state();
  for (int frame = 61; frame <= 75; ++frame) simulator.stepUnobserved(targets, frame * kFrame);
  EXPECT_EQ(simulator.state().observed, 60 * kFrame);
  EXPECT_LT((simulator.state().vertices - seen.vertices).rowwise().norm().maxCoeff(), 1e-4);
  for (std::size_t v = 0; v < seen.confidence.size(); ++v)
    EXPECT_NEAR(simulator.state().confidence[v], 0.5f * seen.confidence[v], 1e-3f);
  ASSERT_EQ(simulator.state().standard_deviation.size(), seen.standard_deviation.size());
  for (std::size_t v = 0; v < seen.standard_deviation.size(); ++v)
    EXPECT_GT(simulator.state().standard_deviation[v], seen.standard_deviation[v]);
  for (int frame = 76; frame <= 76 + 300; ++frame) simulator.stepUnobserved(targets, frame * kFrame);
  EXPECT_LT(*std::max_element(simulator.state().confidence.begin(), simulator.state().confidence.end()),
            1e-3f);
  for (const float deviation : simulator.state().standard_deviation) EXPECT_NEAR(deviation, 0.1f, 1e-4f);
}

TEST_P(UnderBothSolvers, DefaultParametersSupportHangingAndLyingBodies) {
  SimulatorConfig config;
  config.solver = GetParam();
  config.gravity = config_.gravity;
  material_.damping = 0.1;
  Surroundings lying, hanging;
  lying.obstacles = {Obstacle::plane()};
  lying.obstacles[0].pose = Eigen::Translation3d(0.0, 0.0, -0.05);
  hanging.pins = pinsWhere([](const Eigen::Vector3d& p) { return p.x() < 0.03; });
  for (const Surroundings& surroundings : {lying, hanging}) {
    Simulator simulator(topology_, material_, config);
    place(&simulator);
    for (int frame = 1; frame <= 150; ++frame) simulator.step({}, frame * kFrame, surroundings);
    const Wrench sum = sumAboutOrigin(simulator, surroundings);
    EXPECT_LT((sum.force - Eigen::Vector3d(0.0, 0.0, -kWeight)).norm(), 1e-3 * kWeight);
  }
}

TEST_P(UnderBothSolvers, ABodyThatIsPlacedAgainMeetsObstaclesAtTheirPoses) {
  config_.gravity.setZero();
  Simulator simulator(topology_, material_, config_);
  Surroundings surroundings;
  surroundings.obstacles = {Obstacle::sphere(0.02)};
  TargetSet reset;
  reset.reset = true;
  for (const double side : {-1.0, 1.0}) {
    surroundings.obstacles[0].pose = Eigen::Translation3d(0.1, 0.05, 0.5 * side);
    simulator.step(reset, kFrame, surroundings);
    EXPECT_LT((simulator.state().vertices - topology_.rest_vertices).norm(), 1e-9) << side;
  }
}

TEST_P(UnderBothSolvers, AnObstacleThatComesDoesNotSweepFromTheOneThatWent) {
  config_.gravity.setZero();
  for (const bool changed : {false, true}) {
    Simulator simulator(topology_, material_, config_);
    place(&simulator);
    Surroundings surroundings;
    surroundings.obstacles = {Obstacle::sphere(0.02)};
    surroundings.obstacles[0].pose = Eigen::Translation3d(0.1, 0.05, 0.1);
    simulator.step({}, kFrame, surroundings);
    surroundings.obstacles[0].pose = Eigen::Translation3d(0.1, 0.05, -0.1);
    surroundings.obstacles_changed = changed;
    simulator.step({}, 2 * kFrame, surroundings);
    const double moved = (simulator.state().vertices - topology_.rest_vertices).norm();
    EXPECT_EQ(moved < 1e-9, changed) << moved;  // the same obstacle pushes the body on its way
  }
}

TEST_P(UnderBothSolvers, AMaterialThatIsSetLaterEqualsOneFromTheStart) {
  Material soft = material_, stiff = material_;
  stiff.youngs_modulus_pa *= 4.0;
  stiff.density_kg_m3 *= 1.5;
  Surroundings surroundings;
  surroundings.pins = pinsWhere([](const Eigen::Vector3d& p) { return p.x() < 1e-9; });
  Simulator changed(topology_, soft, config_), expected(topology_, stiff, config_);
  for (Simulator* simulator : {&changed, &expected}) {
    place(simulator);
    simulator->settle({}, surroundings);
  }
  const Points before = changed.state().vertices;
  EXPECT_GT((before - expected.state().vertices).rowwise().norm().maxCoeff(), 1e-3);
  changed.setMaterial(stiff);
  EXPECT_TRUE(changed.state().vertices == before);
  changed.settle({}, surroundings);
  EXPECT_LT((changed.state().vertices - expected.state().vertices).rowwise().norm().maxCoeff(), 1e-5);
  soft.poisson_ratio = 0.5;
  EXPECT_THROW(changed.setMaterial(soft), std::invalid_argument);
  soft = material_;
  soft.damping = std::nan("");
  EXPECT_THROW(changed.setMaterial(soft), std::invalid_argument);
}

TEST_P(UnderBothSolvers, RefuseUnusableSurroundings) {
  Simulator simulator(topology_, material_, config_);
  place(&simulator);
  const Points before = simulator.state().vertices;
  Surroundings bad;
  bad.pins = {{132, Eigen::Vector3d::Zero()}};
  EXPECT_THROW(simulator.step({}, kFrame, bad), std::invalid_argument);
  bad = {};
  bad.loads = Points::Zero(5, 3);
  EXPECT_THROW(simulator.step({}, kFrame, bad), std::invalid_argument);
  bad = {};
  bad.obstacles = {Obstacle::plane()};
  bad.obstacles[0].pose.translation().x() = std::nan("");
  EXPECT_THROW(simulator.settle({}, bad), std::invalid_argument);
  EXPECT_TRUE(simulator.state().vertices == before);
}

INSTANTIATE_TEST_SUITE_P(Solver, UnderBothSolvers,
                         ::testing::Values(SolverKind::kProjectiveDynamics, SolverKind::kFem),
                         [](const auto& info) {
                           return std::string(info.param == SolverKind::kFem ? "Fem" : "Pd");
                         });

}  // namespace
}  // namespace softbody
