#include <test_support/gtest.h>
#include <yaml-cpp/yaml.h>

#include "fixtures/test_meshes.h"
#include "softbody_common/protocol/target_limits.h"
#include "softbody_sim/dynamics/simulator.h"

namespace softbody {
namespace {

TEST(SimulatorConfig, ReadsItsParametersAndNamesWhatIsOutOfRange) {
  Parameters good(YAML::Load("{iterations: 7, gravity_m_s2: [0, 9.81, 0]}"), "/simulator/");
  const SimulatorConfig config = simulatorParameters().read(good);
  EXPECT_EQ(config.iterations, 7);
  EXPECT_EQ(config.gravity.y(), 9.81);
  EXPECT_TRUE(good.unknown().empty());
  Parameters bad(YAML::Load("{iterations: 0}"), "/simulator/");
  EXPECT_TRUE(says(complaint([&] { simulatorParameters().read(bad); }), "/simulator/iterations is 0"));
}

TEST(SimulatorConfig, LeavesRoomForTheTrackersHeaviestTargets) {
  for (const bool single : {false, true}) {
    SimulatorConfig config;
    config.single_precision = single;
    config.target_stiffness = largestStiffness(config) / kLargestTargetWeight;
    EXPECT_NO_THROW(requireConsistent(config));
    config.target_stiffness *= 1.01;
    EXPECT_THROW(requireConsistent(config), std::invalid_argument);
  }
}

Simulator placedSponge(const SimulatorConfig& config) {
  const TetTopology topology = testing::sponge();
  Simulator simulator(topology, Material(), config);
  simulator.step(testing::placing(Eigen::Isometry3d::Identity()), 0);
  return simulator;
}

Points afterPulling(Simulator* simulator) {
  TargetSet targets;
  const Points goal = transformed(simulator->topology().rest_vertices, testing::somePose());
  targets.targets = testing::vertexTargets(simulator->topology(), goal);
  for (int frame = 1; frame <= 3; ++frame) simulator->step(targets, frame * testing::kFrame);
  return simulator->state().vertices;
}

TEST(SimulatorConfig, ChangesBetweenStepsAsIfItHadBeenSoFromTheStart) {
  SimulatorConfig soft;
  soft.target_stiffness = 0.01;
  soft.memory_s = 0.0;
  Simulator changed = placedSponge(SimulatorConfig()), from_start = placedSponge(soft),
            unchanged = placedSponge(SimulatorConfig());
  changed.setConfig(soft);
  EXPECT_EQ(changed.state().vertices, from_start.state().vertices);
  const Points after = afterPulling(&changed);
  EXPECT_EQ(after, afterPulling(&from_start));
  EXPECT_GT(testing::largestDistance(after, afterPulling(&unchanged)), 1e-4);
}

TEST(SimulatorConfig, StaysIfAnotherOneIsRefused) {
  Simulator simulator = placedSponge(SimulatorConfig()), same = placedSponge(SimulatorConfig());
  SimulatorConfig wrong;
  wrong.elasticity = Elasticity::kNeoHookean;
  EXPECT_THROW(simulator.setConfig(wrong), std::invalid_argument);
  EXPECT_EQ(simulator.config().elasticity, Elasticity::kCorotated);
  EXPECT_EQ(afterPulling(&simulator), afterPulling(&same));
}

TEST(SimulatorConfig, WithoutLoadsThereAreNoStandardDeviations) {
  Simulator simulator = placedSponge(SimulatorConfig());
  afterPulling(&simulator);
  ASSERT_FALSE(simulator.state().standard_deviation.empty());
  SimulatorConfig config;
  config.load_fade_s = 0.0;
  simulator.setConfig(config);
  EXPECT_TRUE(simulator.state().standard_deviation.empty());
}

/// Where a body's middle goes in frames without targets, after one target has pulled a body that is held.
Eigen::RowVector3d driftAfterPulling(double load_fade_s) {
  Simulator simulator = placedSponge(SimulatorConfig());
  TargetSet targets;
  targets.targets = testing::vertexTargets(simulator.topology(), simulator.topology().rest_vertices);
  targets.targets.front().position.x() += 0.01;
  for (int frame = 1; frame <= 10; ++frame) simulator.step(targets, frame * testing::kFrame);
  SimulatorConfig config;
  config.load_fade_s = load_fade_s;
  simulator.setConfig(config);
  simulator.setVertices(simulator.topology().rest_vertices);  // without motion and tension
  for (int frame = 11; frame <= 20; ++frame) simulator.stepUnobserved({}, frame * testing::kFrame);
  return simulator.state().vertices.colwise().mean() - simulator.topology().rest_vertices.colwise().mean();
}

TEST(SimulatorConfig, WithoutLoadsNoEarlierLoadPushes) {
  EXPECT_GT(driftAfterPulling(0.1).norm(), 1e-5);
  EXPECT_LT(driftAfterPulling(0.0).norm(), 1e-9);
}

TEST(SimulatorConfig, ChangesWithTheMaterialOrNotAtAll) {
  Simulator simulator = placedSponge(SimulatorConfig()), same = placedSponge(SimulatorConfig());
  SimulatorConfig config;
  config.iterations = 7;
  Material wrong, stiff;
  wrong.poisson_ratio = 0.6;
  stiff.youngs_modulus_pa = 9e4;
  EXPECT_THROW(simulator.change(wrong, config), std::invalid_argument);
  SimulatorConfig unknown = config;
  unknown.simd = "none";
  EXPECT_THROW(simulator.change(stiff, unknown), std::invalid_argument);
  EXPECT_EQ(simulator.config().iterations, SimulatorConfig().iterations);
  EXPECT_EQ(simulator.material().youngs_modulus_pa, Material().youngs_modulus_pa);
  EXPECT_EQ(afterPulling(&simulator), afterPulling(&same));
  simulator.change(stiff, config);
  EXPECT_EQ(simulator.config().iterations, 7);
  EXPECT_EQ(simulator.material().youngs_modulus_pa, 9e4);
}

}  // namespace
}  // namespace softbody
