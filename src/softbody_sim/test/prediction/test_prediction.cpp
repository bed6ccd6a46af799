#include <test_support/gtest.h>

#include <algorithm>
#include <atomic>
#include <limits>

#include "fixtures/random_plans.h"
#include "softbody_sim/prediction/prediction.h"

namespace softbody {
namespace {

constexpr Nanoseconds kPredictedStep = 33333333;
constexpr double kTimeStep = 1e-9 * kPredictedStep;

Eigen::Isometry3d shifted(double x, double y, double z) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
}

/// A sponge that is held at one end and swings.
class Predictions : public ::testing::Test {
 protected:
  Predictions() : simulator_(topology_, {2e4, 0.2, 30.0, 0.1}, convergingConfig()) {
    for (int v = 0; v < topology_.rest_vertices.rows(); ++v) {
      if (topology_.rest_vertices(v, 0) < 1e-9) hand_.held.push_back({v, topology_.rest_vertices.row(v)});
    }
    surroundings_.pins = hand_.held;
    simulator_.step(testing::placing(Eigen::Isometry3d::Identity()), 0);
    for (int frame = 1; frame <= 5; ++frame) simulator_.step({}, frame * kPredictedStep, surroundings_);
  }
  /// A prediction converges; the simulator that it is compared with has to, too.
  static SimulatorConfig convergingConfig() {
    SimulatorConfig config = testing::PredictionScene::configOf();
    config.iterations = 200;
    return config;
  }
  MotionPlan planOf(const Eigen::Isometry3d& motion) const {
    MotionPlan plan{{hand_}, {}};
    plan.pins[0].path = {{0.2}, {motion}};
    return plan;
  }
  static PredictionSettings settingsOf(std::vector<double> times_s, int threads = 1) {
    return {std::move(times_s), kTimeStep, threads};
  }
  /// What the body weighs [N].
  double weight() const { return 9.81 * 30.0 * 0.2 * 0.1 * 0.03; }

  TetTopology topology_ = testing::sponge();
  Simulator simulator_;
  Surroundings surroundings_;
  PlannedPins hand_{"hand", {}, {}};
};

TEST_F(Predictions, AreWhatTheSimulatorDoesAndLeaveItAlone) {
  const Points before = simulator_.state().vertices;
  const auto predicted = predict(simulator_, {planOf(shifted(0.0, 0.0, 0.03))}, settingsOf({0.11, 0.32}));
  EXPECT_EQ(simulator_.state().vertices, before);
  ASSERT_EQ(predicted.at(0).size(), 2U);
  for (int step = 1; step <= 10; ++step) {
    Surroundings now = surroundings_;
    Wrench sum;
    for (Pin& pin : now.pins) pin.position.z() += 0.03 * std::min(1.0, step * kTimeStep / 0.2);
    simulator_.step({}, (5 + step) * kPredictedStep, now);
    if (step != 4 && step != 10) continue;  // the first steps that reach 0.11 and 0.32 s
    for (const Wrench& wrench : simulator_.reactions().pins) sum.force += wrench.force;
    const PredictedState& state = predicted[0][step == 4 ? 0 : 1];
    EXPECT_NEAR(state.time_s, step * kTimeStep, 1e-9);
    EXPECT_TRUE(state.converged);
    EXPECT_LT((state.vertices - simulator_.state().vertices).rowwise().norm().maxCoeff(), 1e-5);
    EXPECT_LT((state.reactions.at("hand").force - sum.force).norm(), 1e-3 * weight());
  }
}

TEST_F(Predictions, DependNeitherOnThreadsNorOnTheOtherPlans) {
  testing::PredictionScene scene(topology_, {2e4, 0.2, 30.0, 0.1}, 4);
  std::vector<MotionPlan> plans;
  for (int k = 0; k < 3; ++k) {
    plans.push_back(scene.plans.push());
    plans.push_back(scene.plans.grip());
  }
  const auto alone = predict(scene.lying, {plans[4]}, settingsOf({0.5}));
  for (const int threads : {1, 3}) {
    const auto all = predict(scene.lying, plans, settingsOf({0.5}, threads));
    EXPECT_EQ(all.at(4).at(0).vertices, alone.at(0).at(0).vertices);
    EXPECT_NE(all.at(3).at(0).vertices, alone.at(0).at(0).vertices);
  }
}

/// What a worker keeps from plan to plan is used here: factors, a Hessian of a bent body, contacts.
TEST_F(Predictions, DependNotOnTheirOrder) {
  std::vector<MotionPlan> plans;
  testing::RandomPlans random(topology_.rest_vertices, 7);
  for (int k = 0; k < 8; ++k) {
    MotionPlan plan = k % 2 == 0 ? random.lift(hand_) : random.grip();
    plan.obstacles.clear();
    plans.push_back(plan);
  }
  plans.push_back(planOf(shifted(0.0, 0.1, 0.15)));
  plans.push_back(random.push());
  const auto forwards = predict(simulator_, plans, settingsOf({0.5}));
  std::reverse(plans.begin(), plans.end());
  auto backwards = predict(simulator_, plans, settingsOf({0.5}, 2));
  std::reverse(backwards.begin(), backwards.end());
  for (std::size_t k = 0; k < plans.size(); ++k)
    EXPECT_EQ(forwards[k][0].vertices, backwards[k][0].vertices) << k;
}

/// Friction holds the body on a slope. A plan without changes goes on as the simulator does.
TEST_F(Predictions, KeepTheContactsOfThePresent) {
  const Eigen::AngleAxisd slope(0.4, Eigen::Vector3d::UnitY());
  PlannedObstacle table{"table", Obstacle::plane()};
  table.shape.pose = slope;
  table.shape.friction = 0.8;
  table.acts_now = true;
  Simulator lying(topology_, {2e4, 0.2, 30.0, 0.1}, convergingConfig());
  lying.step(testing::placing(Eigen::Isometry3d(slope)), 0);
  Surroundings surroundings;
  surroundings.obstacles = {table.shape};
  for (int frame = 1; frame <= 60; ++frame) lying.step({}, frame * kPredictedStep, surroundings);
  const auto states = predict(lying, {{{}, {table}}}, settingsOf({kTimeStep, 0.3}))[0];
  for (const PredictedState& state : states) {
    EXPECT_TRUE(state.converged);
    EXPECT_LT((state.vertices - lying.state().vertices).rowwise().norm().maxCoeff(), 1e-7);
    EXPECT_NEAR(state.reactions.at("table").force.z(), -weight(), 1e-6 * weight());
  }
}

TEST_F(Predictions, WorkWithoutHistoryAndWithAStiffBody) {
  for (const double youngs_modulus_pa : {2e4, 1e9}) {
    SimulatorConfig config = testing::PredictionScene::configOf();
    config.lbfgs_history = youngs_modulus_pa < 1e6 ? 0 : 5;
    Simulator body(topology_, {youngs_modulus_pa, 0.2, 30.0, 0.1}, config);
    body.step(testing::placing(Eigen::Isometry3d::Identity()), 0);
    const PredictedState state = predict(body, {planOf(shifted(0.0, 0.0, 0.02))}, settingsOf({1.0}))[0][0];
    EXPECT_TRUE(state.converged) << youngs_modulus_pa;
    EXPECT_NEAR(state.reactions.at("hand").force.z(), -weight(), 5e-3 * weight()) << youngs_modulus_pa;
  }
}

TEST_F(Predictions, OfRandomPlansConverge) {
  int converged = 0, count = 0;
  for (unsigned seed = 0; seed < 4; ++seed) {
    testing::RandomPlans random(topology_.rest_vertices, seed);
    testing::PredictionScene scene(topology_, {random.logUniform(5e3, 5e5), 0.2, 30.0, 0.1}, seed);
    for (int k = 0; k < 4; ++k) {
      const auto held = predict(scene.held, {scene.plans.lift(scene.hand)}, {{1.0}});
      const auto lying = predict(scene.lying, {scene.plans.push(), scene.plans.grip()}, {{1.0}});
      for (const auto& states : {held[0], lying[0], lying[1]}) {
        converged += states[0].converged;
        ++count;
      }
    }
  }
  EXPECT_EQ(converged, count);
}

TEST_F(Predictions, LetGoAndGripAtTheirTimes) {
  MotionPlan plan = planOf(Eigen::Isometry3d::Identity());
  plan.pins[0].period.end_s = 0.2;
  PlannedPins grip{"grip", {}, PinRegion{"", "", {-0.01, -0.01, -1.0}, {0.05, 0.2, 1.0}, true}};
  grip.path = {{0.4, 0.7}, {Eigen::Isometry3d::Identity(), shifted(0.0, 0.0, 0.02)}};
  grip.period = {0.3, 0.8};
  plan.pins.push_back(grip);
  const auto states = predict(simulator_, {plan}, settingsOf({0.1, 0.25, 0.35, 0.75, 0.9}))[0];
  const auto names = [&](std::size_t k) {
    std::string all;
    for (const auto& [name, wrench] : states[k].reactions) all += name;
    return all;
  };
  EXPECT_EQ(names(0), "hand");
  EXPECT_EQ(names(1), "");
  EXPECT_EQ(names(2), "grip");
  EXPECT_EQ(names(3), "grip");
  EXPECT_EQ(names(4), "");
  const auto height = [&](std::size_t k, int vertex) { return states[k].vertices(vertex, 2); };
  EXPECT_NEAR(height(3, 0) - height(2, 0), 0.02, 1e-4);
  EXPECT_LT(height(1, 0), height(0, 0) - 1e-3);  // it falls
  EXPECT_LT(height(4, 0), height(3, 0) - 1e-3);
}

TEST_F(Predictions, SayWhichPinOfWhichPlanHoldsNothing) {
  MotionPlan bad = planOf(Eigen::Isometry3d::Identity());
  bad.pins.push_back({"grip", {}, PinRegion{"", "", {5.0, 5.0, 5.0}, {6.0, 6.0, 6.0}}});
  const std::string said = complaint([&] {
    predict(simulator_, {planOf(Eigen::Isometry3d::Identity()), bad}, settingsOf({0.1}, 2));
  });
  EXPECT_EQ(said.rfind("plan 1: pin 'grip' holds nothing", 0), 0U) << said;
}

/// Two boxes stand in the way of a body that a third pushes from above.
TEST_F(Predictions, SumsOfPatchesAreTheReactions) {
  MotionPlan plan;
  for (const double x : {0.03, 0.17}) {
    PlannedObstacle leg{"legs", Obstacle::box({0.04, 0.2, 0.04}, 0.005), {}};
    leg.name += x < 0.1 ? "_left" : "_right";
    leg.shape.pose = shifted(x, 0.05, -0.04);
    leg.shape.friction = 0.5;
    plan.obstacles.push_back(leg);
  }
  PlannedObstacle comb{"comb", Obstacle::box({0.2, 0.2, 0.02}, 0.0), {}};
  comb.shape.pose = shifted(0.1, 0.05, 0.06);
  comb.path = {{0.5}, {shifted(0.0, 0.0, -0.045)}};
  plan.obstacles.push_back(comb);
  const PredictedState state = predict(simulator_, {plan}, settingsOf({0.6}))[0][0];
  std::map<std::string, Wrench> sums;
  for (std::size_t k = 0; k < state.contacts.size(); ++k) {
    const ContactPatch& patch = state.contacts[k];
    Wrench& sum = sums[state.contact_names[k]];
    sum.force += patch.force;
    sum.torque += patch.torque + patch.place.cross(patch.force);
    EXPECT_NEAR(patch.normal.norm(), 1.0, 1e-9);
    EXPECT_LT(patch.normal.dot(patch.force), 0.0);  // the body presses on the obstacle
  }
  EXPECT_EQ(sums.size(), 3U);
  for (const auto& [name, wrench] : sums) {
    EXPECT_LT((wrench.force - state.reactions.at(name).force).norm(), 1e-9) << name;
    EXPECT_LT((wrench.torque - state.reactions.at(name).torque).norm(), 1e-9) << name;
    EXPECT_GT(wrench.force.norm(), 0.1 * weight()) << name;
  }
}

TEST_F(Predictions, ReportProgressAndEndWhenTheyAreCancelled) {
  const std::vector<MotionPlan> plans(8, planOf(shifted(0.0, 0.0, 0.01)));
  std::vector<std::size_t> done;
  PredictionSettings settings = settingsOf({0.3}, 2);
  settings.on_progress = [&](std::size_t count) { done.push_back(count); };
  EXPECT_EQ(predict(simulator_, plans, settings).size(), plans.size());
  EXPECT_EQ(done, (std::vector<std::size_t>{1, 2, 3, 4, 5, 6, 7, 8}));
  std::atomic<int> steps{0};
  settings.is_cancelled = [&] { return ++steps > 12; };
  EXPECT_TRUE(predict(simulator_, plans, settings).empty());
  EXPECT_LT(steps, 20);
}

/// A body that is stretched becomes thin and leaves the ground. Meanwhile its friction goes to zero.
TEST_F(Predictions, ConvergeWhenTheBodyLeavesTheGround) {
  testing::PredictionScene scene(topology_, {2e4, 0.2, 30.0, 0.1}, 2);
  for (const double stretch_m : {0.01, 0.02, 0.03, 0.04, 0.05}) {
    MotionPlan plan{{}, {scene.plans.table()}};
    plan.obstacles[0].shape.friction = 0.3;
    for (const double side : {-1.0, 1.0}) {
      const double end = 0.1 + side * 0.1, inside = 0.1 + side * 0.07;
      PlannedPins grip{side < 0.0 ? "left" : "right", {}, PinRegion{"", "", {}, {}}};
      grip.region->min = {std::min(end, inside) - 1e-3, -1.0, -1.0};
      grip.region->max = {std::max(end, inside) + 1e-3, 1.0, 1.0};
      grip.accuracy_m = 0.001;
      grip.path = {{1.0}, {shifted(stretch_m * side, 0.0, 0.0)}};
      plan.pins.push_back(grip);
    }
    EXPECT_TRUE(predict(scene.lying, {plan}, settingsOf({1.0}))[0][0].converged) << stretch_m;
  }
}

TEST(RigidPath, TurnsAboutTheCentre) {
  const Eigen::Vector3d center(0.0, 0.1, 0.5);
  const Eigen::AngleAxisd turn(M_PI / 2, Eigen::Vector3d::UnitX());
  const RigidPath path{
      {1.0}, {shifted(0.02, 0.0, 0.0) * Eigen::Translation3d(center) * turn * Eigen::Translation3d(-center)}};
  for (const double time_s : {0.0, 0.3, 1.0, 2.0}) {
    const double share = std::min(1.0, time_s);
    EXPECT_LT((path.at(time_s, center) * center - center - Eigen::Vector3d(0.02 * share, 0.0, 0.0)).norm(),
              1e-12);
    EXPECT_NEAR(Eigen::AngleAxisd(path.at(time_s, center).linear()).angle(), share * M_PI / 2, 1e-9);
  }
}

TEST(RigidPath, IsLinearAndStaysAtItsEnd) {
  Eigen::Isometry3d motion(Eigen::Translation3d(0.0, 0.02, 0.0) *
                           Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitX()));
  const RigidPath path{{1.0, 2.0}, {motion, Eigen::Isometry3d::Identity()}};
  EXPECT_TRUE(path.at(0.0, Eigen::Vector3d::Zero()).isApprox(Eigen::Isometry3d::Identity()));
  EXPECT_NEAR(path.at(0.5, Eigen::Vector3d::Zero()).translation().y(), 0.01, 1e-12);
  EXPECT_NEAR(Eigen::AngleAxisd(path.at(1.5, Eigen::Vector3d::Zero()).linear()).angle(), 0.2, 1e-12);
  EXPECT_TRUE(path.at(1.0, Eigen::Vector3d::Zero()).isApprox(motion));
  EXPECT_TRUE(path.at(9.0, Eigen::Vector3d::Zero()).isApprox(Eigen::Isometry3d::Identity()));
}

}  // namespace
}  // namespace softbody
