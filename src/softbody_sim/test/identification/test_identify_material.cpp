#include <test_support/gtest.h>

#include <cmath>
#include <limits>

#include "identification/sagging_beam.h"

namespace softbody {
namespace {

using testing::propertyOf;
using testing::SaggingBeam;

TEST(IdentifyMaterial, ExactShapesGiveBackTheMaterial) {
  SaggingBeam beam;
  beam.problem.free.poisson_ratio = true;
  beam.problem.prior.poisson_ratio = 0.1;
  beam.observe(beam.clamp);
  const MaterialEstimate estimate = identifyMaterial(beam.problem);
  EXPECT_NEAR(estimate.material.youngs_modulus_pa, 4e4, 0.1) << reportOf(estimate);
  EXPECT_NEAR(estimate.material.poisson_ratio, 0.3, 1e-5) << reportOf(estimate);
  EXPECT_LT(estimate.observations.at(0).rms_after_m, 1e-7);
  EXPECT_GT(estimate.observations.at(0).rms_before_m, 1e-3);
}

TEST(IdentifyMaterial, TheTargetsMayBeOffByARigidMotion) {
  SaggingBeam beam;
  beam.observe(beam.clamp);
  const Eigen::Isometry3d off = Eigen::Translation3d(0.003, -0.002, 0.004) *
                                Eigen::AngleAxisd(0.05, Eigen::Vector3d(1.0, 2.0, 3.0).normalized());
  for (Target& target : beam.problem.observations[0].targets) target.position = off * target.position;
  const MaterialEstimate estimate = identifyMaterial(beam.problem);
  EXPECT_NEAR(estimate.material.youngs_modulus_pa, 4e4, 0.1) << reportOf(estimate);
  EXPECT_TRUE(estimate.alignment.isApprox(off, 1e-6));
}

/// With one mesh for both, only the statistical error counts.
TEST(IdentifyMaterial, NoisySagHasTheTruthWithinTwoStandardErrors) {
  int inside = 0;
  SaggingBeam exact;
  exact.observe(exact.clamp);
  for (unsigned seed = 1; seed <= 20; ++seed) {
    SaggingBeam beam = exact;
    beam.random.seed(seed);
    beam.problem.observations[0].targets = beam.noisy(beam.problem.observations[0].targets, 1e-3);
    const EstimatedProperty modulus = propertyOf(identifyMaterial(beam.problem), "youngs_modulus_pa");
    EXPECT_TRUE(modulus.observable);
    inside += std::abs(modulus.value - 4e4) < 2.0 * modulus.statistical ? 1 : 0;
  }
  EXPECT_GE(inside, 19);
}

/// All targets of a patch have the same error, as features that were placed on the body at once.
TEST(IdentifyMaterial, ErrorsOfNeighboursMakeTheStandardErrorLarger) {
  int inside = 0;
  double factor = 0.0;
  SaggingBeam exact;
  exact.observe(exact.clamp);
  for (unsigned seed = 1; seed <= 20; ++seed) {
    SaggingBeam beam = exact;
    beam.random.seed(seed);
    std::vector<Target>& targets = beam.problem.observations[0].targets;
    const std::vector<Target> once = beam.noisy(targets, 1e-3);
    targets.clear();
    for (const Target& target : once) targets.insert(targets.end(), 16, target);
    const EstimatedProperty modulus = propertyOf(identifyMaterial(beam.problem), "youngs_modulus_pa");
    inside += std::abs(modulus.value - 4e4) < 2.0 * modulus.statistical ? 1 : 0;
    factor += modulus.correlation_factor / 20.0;
  }
  EXPECT_GE(inside, 18);
  EXPECT_GT(factor, 6.0);
}

TEST(IdentifyMaterial, AForceAtPinsGivesTheStiffness) {
  SaggingBeam beam;
  beam.problem.simulator.gravity.setZero();
  beam.problem.mass_std = std::numeric_limits<double>::infinity();
  beam.problem.free.poisson_ratio = true;
  beam.observe(beam.pulled({0.0, 0.0, 0.0}), 0.5e-3, 0.01);
  beam.observe(beam.pulled({0.02, 0.0, 0.0}), 0.5e-3, 0.01);
  const MaterialEstimate estimate = identifyMaterial(beam.problem);
  const EstimatedProperty& modulus = propertyOf(estimate, "youngs_modulus_pa");
  EXPECT_TRUE(modulus.observable) << estimate.sentence;
  EXPECT_NEAR(modulus.value, 4e4, 2.5 * modulus.statistical) << reportOf(estimate);
  EXPECT_LT(modulus.statistical, 0.05 * modulus.value);
  EXPECT_NEAR(estimate.material.poisson_ratio, 0.3, 0.1) << reportOf(estimate);
}

/// A ball of known weight bends the beam; its place is measured, too.
TEST(IdentifyMaterial, AKnownWeightLaidOnGivesTheStiffness) {
  SaggingBeam beam;
  beam.problem.simulator.gravity.setZero();
  beam.problem.mass_std = std::numeric_limits<double>::infinity();
  Surroundings loaded = beam.clamp;
  loaded.obstacles = {Obstacle::sphere(0.02)};
  loaded.obstacles[0].pose.translation() = Eigen::Vector3d(0.1, 0.015, 0.042);
  beam.observe(loaded);
  MeasuredWrench weight;
  weight.obstacle = 0;
  weight.force_std_n = 1e-3;
  beam.problem.observations[0].wrenches = {weight};
  // What the true body carries is what the same problem finds with the true material.
  MaterialProblem known = beam.problem;
  known.prior = beam.truth;
  known.free.youngs_modulus = false;
  const Eigen::Vector3d force = identifyMaterial(known).observations.at(0).wrenches.at(0).force;
  EXPECT_GT(force.z(), 0.01);
  beam.problem.observations[0].wrenches[0].value.force = force;
  const MaterialEstimate estimate = identifyMaterial(beam.problem);
  EXPECT_TRUE(propertyOf(estimate, "youngs_modulus_pa").observable) << reportOf(estimate);
  EXPECT_NEAR(estimate.material.youngs_modulus_pa, 4e4, 10.0) << reportOf(estimate);
}

TEST(IdentifyMaterial, WithoutWeightAndForceTheStiffnessIsNotObservable) {
  SaggingBeam beam;
  beam.problem.simulator.gravity.setZero();
  beam.problem.free.poisson_ratio = true;
  beam.observe(beam.pulled({0.02, 0.0, 0.01}), 1e-4);
  const MaterialEstimate estimate = identifyMaterial(beam.problem);
  const EstimatedProperty& modulus = propertyOf(estimate, "youngs_modulus_pa");
  EXPECT_FALSE(modulus.observable);
  EXPECT_TRUE(says(modulus.why, "add a known weight or force"));
  EXPECT_EQ(estimate.material.youngs_modulus_pa, 1e5);
  EXPECT_FALSE(estimate.material.youngs_modulus_std_pa);
  EXPECT_TRUE(propertyOf(estimate, "poisson_ratio").observable) << reportOf(estimate);
}

TEST(IdentifyMaterial, WithoutTheMassOnlyTheModulusOverTheDensityShows) {
  SaggingBeam beam;
  beam.problem.mass_std = std::numeric_limits<double>::infinity();
  beam.problem.prior.density_kg_m3 = 30.0;
  beam.observe(beam.clamp);
  const MaterialEstimate estimate = identifyMaterial(beam.problem);
  EXPECT_FALSE(propertyOf(estimate, "youngs_modulus_pa").observable);
  EXPECT_NEAR(estimate.modulus_over_density, 4e4 / 300.0, 1e-3) << reportOf(estimate);
  EXPECT_TRUE(says(estimate.sentence, "the mass is not known"));
}

TEST(IdentifyMaterial, AMassKnownToATenthAddsATenth) {
  SaggingBeam beam;
  beam.problem.mass_std = 0.1;
  beam.observe(beam.clamp, 0.1e-3);
  const EstimatedProperty modulus = propertyOf(identifyMaterial(beam.problem), "youngs_modulus_pa");
  EXPECT_TRUE(modulus.observable);
  EXPECT_NEAR(modulus.statistical / modulus.value, 0.1, 0.01);
}

TEST(IdentifyMaterial, ABodyThatDoesNotDeformIsNamed) {
  SaggingBeam beam({1e8, 0.3, 300.0, 0.1});
  beam.observe(beam.clamp, 1e-3);
  const MaterialEstimate estimate = identifyMaterial(beam.problem);
  EXPECT_FALSE(propertyOf(estimate, "youngs_modulus_pa").observable) << reportOf(estimate);
  EXPECT_TRUE(says(estimate.sentence, "nothing deforms"));
}

TEST(IdentifyMaterial, RegionsAreFittedOneByOne) {
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const auto outer = [](double modulus) {
    return MaterialRegion{
        {0.06, -kInfinity, -kInfinity}, Eigen::Vector3d::Constant(kInfinity), modulus, 0.3, 300.0};
  };
  SaggingBeam beam({6e4, 0.3, 300.0, 0.1, {outer(2e4)}});
  beam.problem.prior.regions = {outer(1e5)};
  beam.observe(beam.clamp);
  const MaterialEstimate estimate = identifyMaterial(beam.problem);
  EXPECT_NEAR(estimate.material.youngs_modulus_pa, 6e4, 1.0) << reportOf(estimate);
  EXPECT_NEAR(estimate.material.regions.at(0).youngs_modulus_pa, 2e4, 1.0) << reportOf(estimate);
  EXPECT_LT(estimate.correlation(0, 1), 0.0);
}

/// A fine mesh makes the data, a coarse one explains them: its error is named.
TEST(IdentifyMaterial, TheMeshErrorCoversThatOfACoarseMesh) {
  SaggingBeam coarse;
  coarse.problem.topology = testing::boxTopology({6, 2, 2}, {0.12, 0.03, 0.03});
  SaggingBeam fine;
  fine.problem.topology = testing::boxTopology({18, 6, 6}, {0.12, 0.03, 0.03});
  for (SaggingBeam* beam : {&coarse, &fine}) {
    beam->clamp.pins.clear();
    for (int v = 0; v < beam->rest().rows(); ++v)
      if (beam->rest()(v, 0) < 1e-9) beam->clamp.pins.push_back({v, beam->rest().row(v)});
  }
  const Points x = fine.observe(fine.clamp);
  const TetLocator locator(coarse.rest(), coarse.problem.topology.tets);
  ShapeObservation observation;
  observation.surroundings = coarse.clamp;
  for (int v = 0; v < fine.rest().rows(); ++v) {
    Target target;
    target.place = locator.locate(fine.rest().row(v).transpose());
    target.position = x.row(v).transpose();
    observation.targets.push_back(target);
  }
  coarse.problem.observations = {observation};
  const MaterialEstimate estimate = identifyMaterial(coarse.problem);
  const EstimatedProperty& modulus = propertyOf(estimate, "youngs_modulus_pa");
  EXPECT_GT(std::abs(modulus.value - 4e4), 0.02 * 4e4) << "the mesh has no error to name";
  EXPECT_NEAR(modulus.value, 4e4, 2.0 * modulus.mesh) << reportOf(estimate);
  EXPECT_LT(std::abs(estimate.refined_modulus_pa - 4e4), 2.0 * estimate.refined_std_pa) << reportOf(estimate);
  EXPECT_LT(std::abs(estimate.refined_modulus_pa - 4e4), 0.5 * std::abs(modulus.value - 4e4))
      << reportOf(estimate);
}

TEST(IdentifyMaterial, UnusableProblemsAreRefusedWithTheObservation) {
  SaggingBeam beam;
  EXPECT_THROW(identifyMaterial(beam.problem), std::invalid_argument);
  beam.observe(beam.clamp);
  MaterialProblem wrong = beam.problem;
  wrong.observations[0].targets[0].position.x() = std::nan("");
  EXPECT_TRUE(says(complaint([&] { identifyMaterial(wrong); }), "observation 1"));
  wrong = beam.problem;
  wrong.observations[0].wrenches.push_back({});
  EXPECT_THROW(identifyMaterial(wrong), std::invalid_argument);
}

}  // namespace
}  // namespace softbody
