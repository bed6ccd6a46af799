#include <test_support/gtest.h>

#include <cmath>
#include <functional>

#include "fixtures/test_meshes.h"
#include "softbody_sim/dynamics/simulator.h"

namespace softbody {
namespace {

using testing::boxTopology;
using testing::kFrame;

constexpr double kGravity = 9.81, kStep = 1e-9 * kFrame;
constexpr int kFramesPerSecond = 30;

/// A block on a plane, with the settings of the node.
class Block {
 public:
  Block(double youngs_modulus_pa, double density_kg_m3, double friction, double slope)
      : material_{youngs_modulus_pa, 0.2, density_kg_m3, 0.0},
        mass_(density_kg_m3 * kSize.prod()),
        simulator_(topology_, material_, configOf(slope)) {
    ground_.obstacles = {Obstacle::plane()};
    ground_.obstacles[0].friction = friction;
    simulator_.step(testing::placing(Eigen::Isometry3d::Identity()), 0);
  }
  void step() { simulator_.step({}, ++frame_ * kFrame, ground_); }
  /// A step under targets at all vertices, at their present places.
  void observe() {
    TargetSet targets;
    targets.targets = testing::vertexTargets(topology_, simulator_.state().vertices);
    simulator_.step(targets, ++frame_ * kFrame, ground_);
  }
  double force() const { return -simulator_.reactions().obstacles.at(0).force.z(); }
  void lift(double height_m) {
    Points x = simulator_.state().vertices;
    x.col(2).array() += height_m;
    simulator_.setVertices(x);
  }
  Eigen::RowVector3d move() const {
    return (simulator_.state().vertices - topology_.rest_vertices).colwise().mean();
  }
  /// Mean place of the lowest layer along the slope [m].
  double base() const {
    double sum = 0.0;
    int count = 0;
    for (Eigen::Index v = 0; v < topology_.rest_vertices.rows(); ++v) {
      if (topology_.rest_vertices(v, 2) > 1e-9) continue;
      sum += simulator_.state().vertices(v, 0);
      ++count;
    }
    return sum / count;
  }
  double penetration() const { return std::max(0.0, -simulator_.state().vertices.col(2).minCoeff()); }
  double weight() const { return mass_ * kGravity; }
  Simulator& simulator() { return simulator_; }
  Surroundings& surroundings() { return ground_; }

 private:
  static SimulatorConfig configOf(double slope) {
    SimulatorConfig config;
    const double angle = std::atan(slope);
    config.gravity = kGravity * Eigen::Vector3d(std::sin(angle), 0.0, -std::cos(angle));
    return config;
  }

  const Eigen::Vector3d kSize{0.08, 0.08, 0.04};
  const TetTopology topology_ = boxTopology({4, 4, 2}, kSize);
  Material material_;
  double mass_;
  Simulator simulator_;
  Surroundings ground_;
  int frame_ = 0;
};

double logUniform(double low, double high, std::mt19937* random) {
  return low * std::pow(high / low, std::uniform_real_distribution<double>(0.0, 1.0)(*random));
}

/// The distance of implicit Euler under the constant force of gravity and Coulomb friction.
TEST(NodeDefaults, ABlockSlidesAsCoulombSays) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int k = 0; k < 30; ++k) {
    const double friction = k % 5 == 0 ? 0.0 : uniform(random),
                 slope = (1.2 + 2.0 * uniform(random)) * friction + 0.2;
    Block block(logUniform(5e3, 5e6, &random), logUniform(30.0, 1000.0, &random), friction, slope);
    int converged = 0;
    for (int frame = 0; frame < kFramesPerSecond; ++frame) {
      block.step();
      converged += block.simulator().report().converged;
    }
    const double angle = std::atan(slope);
    const double acceleration = kGravity * (std::sin(angle) - friction * std::cos(angle));
    const double distance = acceleration * kStep * kStep * kFramesPerSecond * (kFramesPerSecond + 1) / 2.0;
    EXPECT_NEAR(block.move().x(), distance, 0.02 * distance) << "case " << k;
    EXPECT_GE(converged, kFramesPerSecond - 6) << "case " << k;
  }
}

TEST(NodeDefaults, ABlockSticksBelowTheSlopeOfFriction) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(0.2, 1.0);
  for (int k = 0; k < 15; ++k) {
    const double friction = uniform(random);
    // Softer blocks shear by millimetres before they are at rest.
    Block block(logUniform(2e5, 5e6, &random), logUniform(30.0, 1000.0, &random), friction, 0.9 * friction);
    for (int frame = 0; frame < kFramesPerSecond; ++frame) block.step();
    EXPECT_LT(std::abs(block.base() - 0.04), 5e-4) << "case " << k;
  }
}

TEST(NodeDefaults, ADroppedBlockComesToRestOnTheTable) {
  std::mt19937 random(3);
  for (int k = 0; k < 20; ++k) {
    Block block(logUniform(5e2, 1e7, &random), logUniform(30.0, 300.0, &random), 0.1 * (k % 10), 0.0);
    block.lift(0.1);
    double deepest = 0.0;
    for (int frame = 0; frame < 2 * kFramesPerSecond; ++frame) {
      block.step();
      deepest = std::max(deepest, block.penetration());
    }
    const Points before = block.simulator().state().vertices;
    block.step();
    EXPECT_LT((block.simulator().state().vertices - before).rowwise().norm().maxCoeff(), 1e-4)
        << "case " << k;
    EXPECT_LT(deepest, 5e-4) << "case " << k;
    EXPECT_NEAR(-block.simulator().reactions().obstacles[0].force.z(), block.weight(), 0.02 * block.weight());
  }
}

/// A box pushes the block at constant speed; the force is that of friction.
TEST(NodeDefaults, PushingTakesTheForceOfFriction) {
  for (const double friction : {0.0, 0.3, 0.8}) {
    Block block(5e4, 100.0, friction, 0.0);
    block.surroundings().obstacles.push_back(Obstacle::box({0.02, 0.12, 0.02}, 0.004));
    Obstacle& pusher = block.surroundings().obstacles[1];
    double sum = 0.0;
    int count = 0;
    for (int frame = 0; frame < 2 * kFramesPerSecond; ++frame) {
      pusher.pose.translation() << -0.012 + 0.001 * frame, 0.04, 0.015;
      block.step();
      if (frame < kFramesPerSecond) continue;
      sum -= block.simulator().reactions().obstacles[1].force.x();
      ++count;
    }
    EXPECT_NEAR(sum / count, friction * block.weight(),
                0.05 * friction * block.weight() + 0.005 * block.weight())
        << friction;
  }
}

/// Whatever the stiffness: the pins carry the weight, or the step is not called converged.
TEST(NodeDefaults, ConvergedMeansThatThePinsCarryTheWeight) {
  const TetTopology topology = testing::sponge();
  for (const SolverKind solver : {SolverKind::kProjectiveDynamics, SolverKind::kFem}) {
    int converged = 0;
    for (double youngs_modulus_pa = 1e3; youngs_modulus_pa < 2e11; youngs_modulus_pa *= 10.0) {
      for (const int iterations : {1, 20, 1000}) {
        SimulatorConfig config;
        config.solver = solver;
        config.iterations = iterations;
        config.gravity = {0.0, 0.0, -kGravity};
        Simulator simulator(topology, {youngs_modulus_pa, 0.2, 30.0, 0.0}, config);
        simulator.step(testing::placing(Eigen::Isometry3d::Identity()), 0);
        Surroundings held;
        for (int v = 0; v < topology.rest_vertices.rows(); ++v)
          if (topology.rest_vertices(v, 0) < 1e-9) held.pins.push_back({v, topology.rest_vertices.row(v)});
        simulator.settle({}, held);
        if (!simulator.report().converged) continue;
        ++converged;
        double carried = 0.0;
        for (const Wrench& pin : simulator.reactions().pins) carried -= pin.force.z();
        const double weight = 30.0 * 0.2 * 0.1 * 0.03 * kGravity;
        EXPECT_NEAR(carried, weight, 0.01 * weight) << youngs_modulus_pa << ", " << iterations;
      }
    }
    EXPECT_GE(converged, 16);  // at 1e11 Pa the rounding of pd may exceed its tolerance
  }
}

TEST(NodeDefaults, APieceThatNothingHoldsIsNamed) {
  const TetTopology topology = testing::twoBoxes({2, 2, 1}, {0.04, 0.04, 0.02});
  SimulatorConfig config;
  config.gravity = {0.0, 0.0, -kGravity};
  Simulator simulator(topology, {}, config);
  simulator.step(testing::placing(Eigen::Isometry3d::Identity()), 0);
  Surroundings held;
  held.pins = {{0, topology.rest_vertices.row(0)}};
  EXPECT_TRUE(says(complaint([&] { simulator.settle({}, held); }), "piece 2 of 2"));
  const int last = static_cast<int>(topology.rest_vertices.rows()) - 1;
  held.pins.push_back({last, topology.rest_vertices.row(last)});
  EXPECT_NO_THROW(simulator.settle({}, held));
}

/// What is known to hold the body is no unknown load: the ground carries the weight, seen or not.
TEST(NodeDefaults, TheGroundCarriesABodyThatIsSeen) {
  Block block(2.0e4, 300.0, 0.5, 0.0);
  for (int frame = 0; frame < kFramesPerSecond; ++frame) block.step();
  EXPECT_NEAR(block.force(), block.weight(), 0.02 * block.weight());
  for (int frame = 0; frame < kFramesPerSecond; ++frame) block.observe();
  EXPECT_NEAR(block.force(), block.weight(), 0.05 * block.weight());
}

}  // namespace
}  // namespace softbody
