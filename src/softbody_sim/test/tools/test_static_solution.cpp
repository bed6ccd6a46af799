#include "tools/static_solution.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fixtures/test_meshes.h"
#include "tools/simulation_table.h"

namespace softbody {
namespace {

constexpr double kLength = 0.1, kSide = 0.02, kYoung = 1e5;

/// The bar between two grips, as the command line gives it.
class GrippedBar : public ::testing::TestWithParam<bool> {
 protected:
  GrippedBar() {
    options_.node_defaults = GetParam();
    options_.pins = {"x<1e-9"};
    options_.material = {kYoung, 0.0, 30.0, 0.0};
  }
  /// What the bar does to the end that moves.
  Wrench settle(const TetTopology& topology) {
    requireUsable(options_);
    Simulator simulator(topology, materialOf(options_), configOf(options_));
    simulator.step(testing::placing(Eigen::Isometry3d::Identity()), 0);
    const SimulationProblem problem(options_, topology.rest_vertices);
    const StepReport report = settleInSteps(problem, options_.node_defaults ? 1000 : 1, &simulator);
    EXPECT_TRUE(report.converged) << report.residual_n << " of " << report.external_n << " N";
    EXPECT_EQ(invertedTets(simulator.state().vertices, topology.tets), 0);
    return problem.held.wrenches(simulator.reactions().pins, 1.0)[1];
  }
  SimulateOptions options_;
};

TEST_P(GrippedBar, StretchedItPullsAsHookeSays) {
  const TetTopology topology = testing::boxTopology({10, 2, 2}, {kLength, kSide, kSide});
  for (const double stretch : {-0.001, 0.01, 0.05}) {
    options_.moves = {{"x>0.0999", std::to_string(stretch), "0", "0"}};
    const double force = kYoung * kSide * kSide * stretch / kLength;
    EXPECT_NEAR(settle(topology).force.x(), -force, 0.01 * std::abs(force)) << stretch;
  }
}

/// Saint-Venant: G J theta / L, with J = 0.1406 a^4 of a square.
TEST_P(GrippedBar, TwistedItTurnsBackAsSaintVenantSays) {
  const TetTopology topology = testing::boxTopology({20, 4, 4}, {kLength, kSide, kSide});
  options_.turns = {{"x>0.0999", "1", "0", "0", "10"}};
  const double torque = 0.5 * kYoung * 0.1406 * std::pow(kSide, 4) * (10.0 * M_PI / 180.0) / kLength;
  const Wrench end = settle(topology);
  EXPECT_NEAR(end.torque.x(), -torque, 0.05 * torque);
  EXPECT_LT(end.force.norm() * kSide, 0.05 * torque);
}

/// A turn by a third of a circle, much more than a step of the solver can make.
TEST_P(GrippedBar, TurnedFarItConvergesInSteps) {
  const TetTopology topology = testing::boxTopology({10, 2, 2}, {kLength, kSide, kSide});
  options_.turns = {{"x>0.0999", "1", "0", "0", "120"}};
  EXPECT_LT(settle(topology).torque.x(), 0.0);
}

INSTANTIATE_TEST_SUITE_P(Settings, GrippedBar, ::testing::Bool(),
                         [](const auto& info) { return info.param ? "AsTheNode" : "Fem"; });

TEST(SimulateOptions, WhatCannotBeRunIsRefused) {
  const auto refused = [](const std::function<void(SimulateOptions*)>& set) {
    SimulateOptions options;
    set(&options);
    EXPECT_THROW(requireUsable(options), CLI::ValidationError);
  };
  refused([](SimulateOptions* o) { o->moves = {{"x<0.1", "0", "zero", "0"}}; });
  refused([](SimulateOptions* o) { o->turns = {{"x<0.1", "0", "0", "0", "90"}}; });
  refused([](SimulateOptions* o) {
    o->turns = {{"x<0.1", "1", "0", "0", "9"}, {"x<0.1", "0", "1", "0", "9"}};
  });
  refused([](SimulateOptions* o) { o->materials = {{"x<0.1", "1e4", "0.5", "30"}}; });
  refused([](SimulateOptions* o) { o->pushers = {{0, 0, 0, 0.1, 0.0, 0.1, 0, 0, 0}}; });
}

TEST(SimulationTable, EveryRowHasTheColumnsOfTheHeader) {
  const TetTopology topology = testing::boxTopology({4, 1, 1}, {kLength, kSide, kSide});
  SimulateOptions options;
  options.pins = {"x<1e-9"};
  options.moves = {{"x>0.0999", "0.01", "0", "0"}};
  options.ground = -0.1;
  options.pushers = {{0.1, 0.0, 0.1, 0.02, 0.02, 0.02, 0.0, 0.0, 0.0}};
  Simulator simulator(topology, materialOf(options), configOf(options));
  simulator.step(testing::placing(Eigen::Isometry3d::Identity()), 0);
  const SimulationProblem problem(options, topology.rest_vertices);
  simulator.step({}, 1000000, problem.at(0.5));
  const SimulationTable table(problem, {0});
  const std::string row = table.row(1, 0.0, 0.1, topology.rest_vertices, 0.5, simulator.report(), simulator);
  const auto columns = [](const std::string& line) { return std::count(line.begin(), line.end(), ','); };
  EXPECT_EQ(columns(row), columns(table.header()));
  EXPECT_EQ(columns(row), 14 + 2 * 6 + 2 * 3);
}

}  // namespace
}  // namespace softbody
