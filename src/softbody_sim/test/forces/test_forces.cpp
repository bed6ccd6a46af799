#include <test_support/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "fixtures/model_files.h"
#include "fixtures/test_meshes.h"
#include "softbody_common/protocol/target_limits.h"
#include "softbody_sim/dynamics/simulator.h"

namespace softbody {
namespace {

using testing::boxTopology;
using testing::kFrame;
using testing::randomPoints;
using testing::vertexTargets;

SimulatorConfig configUnder(const Eigen::Vector3d& gravity) {
  SimulatorConfig config;
  config.gravity = gravity;
  return config;
}

Material measuredMaterial() {
  Material material;
  material.youngs_modulus_std_pa = 1.0;
  return material;
}

/// A beam of foam that hangs from one end and is seen from above.
class Beam {
 public:
  enum class End { kHeld, kFree };

  explicit Beam(End end, const Eigen::Vector3i& cells = {8, 4, 2})
      : topology_(boxTopology(cells, {0.2, 0.1, 0.04})),
        simulator_(topology_, material_, configUnder(gravityOf(end))) {
    simulator_.step(testing::placing(Eigen::Isometry3d::Identity()), 0);
    for (int v = 0; v < rest().rows() && end == End::kHeld; ++v) {
      if (rest()(v, 0) < 1e-9) surroundings_.pins.push_back({v, rest().row(v), 0.001});
    }
  }

  /// The shape under forces. @param held a vertex that holds the beam if nothing else does.
  Points loaded(const Points& forces) const {
    SimulatorConfig precise = configUnder(gravityOf(surroundings_.pins.empty() ? End::kFree : End::kHeld));
    precise.tolerance = 1e-9;
    precise.iterations = 500;
    Simulator truth(topology_, material_, precise);
    truth.step(testing::placing(Eigen::Isometry3d::Identity()), 0);
    Surroundings surroundings = surroundings_;
    surroundings.loads = forces;
    if (surroundings.pins.empty()) surroundings.pins.push_back({middle(), rest().row(middle()), 0.0});
    truth.settle({}, surroundings);
    return truth.state().vertices;
  }
  Points loaded(int vertex, const Eigen::Vector3d& force) const {
    Points forces = noForces();
    forces.row(vertex) = force;
    return loaded(forces);
  }

  /// Estimates forces after frames that see a shape. @param noise standard deviation that the targets have,
  /// and, for targets that are more certain than usual, a part of what they say [m].
  ForceEstimate observe(const Points& shape, double noise, double said_noise, std::mt19937* random) {
    std::normal_distribution<double> normal(0.0, noise);
    for (int frame = 0; frame < 3; ++frame) {
      const Points measured = shape + Points::NullaryExpr(shape.rows(), 3, [&] { return normal(*random); });
      const std::vector<Target> all = vertexTargets(topology_, measured);
      seen_.targets.clear();
      for (int v = 0; v < shape.rows(); ++v) {
        if (rest()(v, 2) > 0.039) seen_.targets.push_back(all[static_cast<std::size_t>(v)]);
      }
      const double accuracy = kTargetAccuracy_m / said_noise;
      for (Target& target : seen_.targets) target.weight = accuracy * accuracy;
      simulator_.step(seen_, ++frame_ * kFrame, surroundings_);
    }
    return simulator_.externalForces(seen_, surroundings_);
  }

  int above(double x, double y) const {
    Eigen::Index nearest = 0;
    (rest().rowwise() - Eigen::RowVector3d(x, y, 0.04)).rowwise().norm().minCoeff(&nearest);
    return static_cast<int>(nearest);
  }
  Points noForces() const { return Points::Zero(rest().rows(), 3); }
  double weight() const { return 30.0 * 0.2 * 0.1 * 0.04 * 9.81; }
  const Points& rest() const { return topology_.rest_vertices; }
  Surroundings& surroundings() { return surroundings_; }
  Simulator& simulator() { return simulator_; }

 private:
  static Eigen::Vector3d gravityOf(End end) { return {0.0, 0.0, end == End::kHeld ? -9.81 : 0.0}; }
  int middle() const { return above(0.1, 0.05); }

  const TetTopology topology_;
  const Material material_ = measuredMaterial();
  Simulator simulator_;
  Surroundings surroundings_;
  TargetSet seen_;
  int frame_ = 0;
};

Eigen::Vector3d sumOf(const std::vector<Wrench>& wrenches) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Wrench& wrench : wrenches) sum += wrench.force;
  return sum;
}

TEST(Forces, AKnownLoadIsFoundWhereItActs) {
  Beam beam(Beam::End::kHeld);
  const int vertex = beam.above(0.15, 0.05);
  const Eigen::Vector3d load(0.0, 0.0, -0.3);
  std::mt19937 random(1);
  const Points shape = beam.loaded(vertex, load);
  const ForceEstimate estimate = beam.observe(shape, 0.0, 2e-4, &random);
  ASSERT_EQ(estimate.patches.size(), 1u);
  const ForcePatch& patch = estimate.patches.front();
  const Eigen::Vector3d place = shape.row(vertex);
  EXPECT_LT((patch.force - load).norm(), 0.05 * load.norm());
  EXPECT_LT((patch.place - place).norm(), 0.005);
  EXPECT_GT(patch.normal.z(), 0.8);
  EXPECT_LT((estimate.wrench.head<3>() - load).norm(), 0.05 * load.norm());
  EXPECT_LT((estimate.wrench.tail<3>() - place.cross(load)).norm(), 0.05 * place.cross(load).norm());
  const Eigen::Vector3d carried = sumOf(estimate.pins);
  EXPECT_LT((carried - load + Eigen::Vector3d(0.0, 0.0, beam.weight())).norm(), 0.05 * load.norm());
}

TEST(Forces, KnownLoadsAreLeftOut) {
  Beam beam(Beam::End::kHeld);
  std::mt19937 random(1);
  Points loads = beam.noForces();
  loads.row(beam.above(0.15, 0.05)) << 0.0, 0.0, -0.3;
  const Points shape = beam.loaded(loads);
  beam.surroundings().loads = loads;
  EXPECT_TRUE(beam.observe(shape, 0.0, 2e-4, &random).patches.empty());
}

TEST(Forces, AFreeBodyIsPulledAtBothEnds) {
  Beam beam(Beam::End::kFree);
  std::mt19937 random(1);
  Points loads = beam.noForces();
  const Eigen::Vector3d pull(0.4, 0.0, 0.0);
  loads.row(beam.above(0.2, 0.05)) = pull;
  loads.row(beam.above(0.0, 0.05)) = -pull;
  const ForceEstimate estimate = beam.observe(beam.loaded(loads), 0.0, 2e-4, &random);
  ASSERT_EQ(estimate.patches.size(), 2u);
  for (const ForcePatch& patch : estimate.patches) {
    const Eigen::Vector3d expected = patch.place.x() > 0.1 ? pull : -pull;
    EXPECT_LT((patch.force - expected).norm(), 0.1 * pull.norm()) << patch.force.transpose();
  }
  EXPECT_LT(estimate.wrench.head<3>().norm(), 0.01 * pull.norm());
}

/// Forces that may be on several places have no mean that is in balance: it would carry the body away.
TEST(Forces, OfAFreeBodyAreOnItAndHaveNoTorque) {
  for (unsigned seed = 0; seed < 3; ++seed) {
    Beam beam(Beam::End::kFree);
    std::mt19937 random(seed);
    const Eigen::ArrayXd x = beam.rest().col(0).array() - 0.1;
    Points shape = beam.rest();
    shape.col(2).array() += 2.0 * x * x;
    const ForceEstimate estimate = beam.observe(shape, 0.001, 0.001, &random);
    ASSERT_FALSE(estimate.patches.empty());
    double sum = 0.0;
    for (const ForcePatch& patch : estimate.patches) {
      EXPECT_LT((shape.rowwise() - patch.place.transpose()).rowwise().norm().minCoeff(), 0.025);
      sum += patch.force.norm();
    }
    EXPECT_LT(estimate.wrench.tail<3>().norm(), 0.005 * sum);
  }
}

/// The springs of the camera pull at the pins with the noise of the targets: 0.4 N.
TEST(Forces, APinnedBodyReadsItsWeight) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 20; ++trial) {
    Beam beam(Beam::End::kHeld);
    const Points shape = beam.loaded(beam.noForces());
    const ForceEstimate estimate = beam.observe(shape, 0.001, 0.001, &random);
    EXPECT_TRUE(estimate.patches.empty()) << trial;
    EXPECT_NEAR(sumOf(estimate.pins).z(), -beam.weight(), 0.03) << trial;
  }
}

/// The tracker holds a hidden body in its place with priors.
TEST(Forces, APinnedBodyThatIsNotMeasuredReadsItsWeight) {
  Beam beam(Beam::End::kHeld);
  TargetSet hidden;
  hidden.targets = vertexTargets(beam.simulator().topology(), beam.rest());
  for (Target& target : hidden.targets) target.kind = TargetKind::kPrior;
  beam.simulator().step({}, kFrame, beam.surroundings());
  const ForceEstimate estimate = beam.simulator().externalForces(hidden, beam.surroundings());
  EXPECT_TRUE(estimate.patches.empty());
  EXPECT_NEAR(sumOf(estimate.pins).z(), -beam.weight(), 0.03);
}

/// Every second vertex is pinned, so that the loaded one is alone in its place.
TEST(Forces, APlaceThatIsPartlyPinnedHasItsWholeForce) {
  const Eigen::Vector3d cell(0.2 / 14, 0.1 / 7, 0.02), load(0.0, 0.0, -2.0);
  Beam beam(Beam::End::kFree, {14, 7, 2});
  for (int v = 0; v < beam.rest().rows(); ++v) {
    const Eigen::Vector3d rest = beam.rest().row(v);
    if (std::lround(rest.cwiseQuotient(cell).sum()) % 2 == 0)
      beam.surroundings().pins.push_back({v, rest, 0.0});
  }
  std::mt19937 random(1);
  const Points shape = beam.loaded(beam.above(5 * cell.x(), 4 * cell.y()), load);
  const ForceEstimate estimate = beam.observe(shape, 0.0, 2e-4, &random);
  EXPECT_LT((estimate.wrench.head<3>() - load).norm(), 0.05 * load.norm()) << estimate.wrench.transpose();
}

/// Some places of a force are then less probable than others by more than a number can hold.
TEST(Forces, AStronglyBentBodyHasFiniteForces) {
  for (unsigned seed = 0; seed < 4; ++seed) {
    Beam beam(Beam::End::kFree, {6, 3, 1});
    std::mt19937 random(seed);
    const Points bend = 20.0 * randomPoints(3, 0.1, &random);
    const Eigen::ArrayXd x = beam.rest().col(0).array() - 0.1, y = beam.rest().col(1).array() - 0.05;
    Points shape = beam.rest();
    for (int c = 0; c < 3; ++c)
      shape.col(c).array() += bend(0, c) * x * x + bend(1, c) * x * y + bend(2, c) * y * y;
    const ForceEstimate estimate = beam.observe(shape, 1e-4, 1e-4, &random);
    EXPECT_FALSE(estimate.patches.empty());
    EXPECT_TRUE(estimate.wrench.allFinite() && estimate.wrench_covariance.allFinite());
  }
}

TEST(Forces, TheCovarianceCoversTheError) {
  constexpr double k90Percent = 6.25;  // of the squared lengths of three standard normal numbers
  std::mt19937 random(3);
  int within = 0, found = 0;
  for (int trial = 0; trial < 200; ++trial) {
    Beam beam(Beam::End::kHeld, {6, 3, 1});
    const int vertex = beam.above(0.1 + 0.033 * (trial % 3), 0.033 * (1 + trial % 2));
    const Eigen::Vector3d load = 0.5 * Eigen::Vector3d(randomPoints(1, 1.0, &random).row(0)).normalized();
    const ForceEstimate estimate = beam.observe(beam.loaded(vertex, load), 0.001, 0.001, &random);
    if (estimate.patches.empty()) continue;
    const Eigen::Vector3d error = estimate.wrench.head<3>() - load;
    const Eigen::Matrix3d covariance = estimate.wrench_covariance.topLeftCorner<3, 3>();
    ++found;
    within += error.dot(covariance.ldlt().solve(error)) < k90Percent ? 1 : 0;
  }
  EXPECT_GE(found, 190);
  EXPECT_GE(within, 0.85 * found);
  EXPECT_LE(within, 0.95 * found);
}

TEST(Forces, WithoutAMeasuredStiffnessTheyAreInItsUnits) {
  ForceEstimate estimate;
  estimate.patches.resize(1);
  estimate.patches[0].force << 2.0, 0.0, 0.0;
  estimate.patches[0].covariance = Eigen::Vector3d(0.01, 0.04, 0.09).asDiagonal();
  estimate.wrench << 2.0, 0.0, 0.0, 0.0, 0.0, 0.2;
  Material material;
  material.youngs_modulus_pa = 1e4;
  const ForceEstimate unknown = inKnownUnit(estimate, material);
  EXPECT_FALSE(unknown.in_newtons);
  EXPECT_NEAR(unknown.patches[0].force.x(), 2e-4, 1e-15);
  EXPECT_NEAR(unknown.patches[0].covariance(1, 1), 4e-10, 1e-18);
  material.youngs_modulus_std_pa = 1e3;
  const ForceEstimate known = inKnownUnit(estimate, material);
  EXPECT_TRUE(known.in_newtons);
  EXPECT_EQ(known.patches[0].force.x(), 2.0);
  EXPECT_NEAR(known.patches[0].covariance(0, 0), 0.01 + 0.04, 1e-12);
  EXPECT_NEAR(known.wrench_covariance(0, 5), 0.01 * 2.0 * 0.2, 1e-12);
}

TEST(Forces, TheWrenchMovesToAnotherFrame) {
  ForceEstimate estimate;
  estimate.wrench << 0.0, 0.0, -2.0, 0.0, 0.6, 0.0;  // acts at x = 0.3
  estimate.wrench_covariance.setIdentity();
  Eigen::Isometry3d pose(Eigen::AngleAxisd(M_PI / 2.0, Eigen::Vector3d::UnitZ()));
  pose.translation() << 0.3, 0.0, 0.0;
  const ForceEstimate moved = withWrenchIn(estimate, pose);
  EXPECT_LT((moved.wrench.head<3>() - Eigen::Vector3d(0.0, 0.0, -2.0)).norm(), 1e-12);
  EXPECT_LT(moved.wrench.tail<3>().norm(), 1e-12);
  const Eigen::Matrix3d of_torque = moved.wrench_covariance.bottomRightCorner<3, 3>();
  EXPECT_NEAR(of_torque.trace(), 3.0 + 2.0 * 0.09, 1e-12);
}

TEST(Forces, OfABodyThatIsNotPlacedAreNotKnown) {
  Simulator simulator(testing::sponge(), Material(), SimulatorConfig());
  EXPECT_EQ(complaint([&] { simulator.externalForces({}); }), "the body is not placed yet");
}

}  // namespace
}  // namespace softbody
