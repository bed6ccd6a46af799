#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "fixtures/test_meshes.h"
#include "time_step/projective_dynamics.h"

namespace softbody {
namespace {

using testing::randomPoints;

struct Step {
  TetTopology topology = testing::sponge();
  Eigen::Index count = topology.rest_vertices.rows();
  Lame lame = lameParameters(2.0e4, 0.3);
  IncrementalPotential potential;

  Step() {
    potential.inertia = Eigen::VectorXd::Constant(count, 2.0);
    potential.prediction = topology.rest_vertices;
    potential.loads = Points::Zero(count, 3);
  }
  void pullTo(const Points& positions, bool with_normals, std::mt19937* random) {
    std::vector<Target> targets = testing::vertexTargets(topology, positions);
    for (Target& target : targets) {
      if (with_normals) target.normal = randomPoints(1, 1.0, random).transpose().normalized();
    }
    targets.resize(100);
    potential.targets.set(targets, topology.tets, 300.0);
  }
  StepReport run(const ProjectiveDynamicsOptions& options, Points* x) const {
    return ProjectiveDynamics(topology, lame, options).minimize(potential, x);
  }
  double energyAt(const Points& x) const {
    Points gradient(count, 3);
    const double outer = potential.evaluate(x, &gradient);
    return outer + CorotatedElasticity(topology.rest_vertices, topology.tets, lame).addTo(x, &gradient);
  }
};

ProjectiveDynamicsOptions withHistory(int history, int iterations) {
  ProjectiveDynamicsOptions options;
  options.minimizer = {iterations, 0.0, history};
  return options;
}

TEST(ProjectiveDynamics, EnergyNeverRisesInAnIteration) {
  std::mt19937 random(3);
  for (double disorder : {0.0, 0.002, 0.02, 0.2}) {
    for (bool with_normals : {false, true}) {
      Step step;
      step.pullTo(transformed(step.topology.rest_vertices, testing::somePose()), with_normals, &random);
      Points x = step.topology.rest_vertices + randomPoints(step.count, disorder, &random);
      ProjectiveDynamics solver(step.topology, step.lame, withHistory(0, 1));
      double previous = step.energyAt(x);
      for (int iteration = 0; iteration < 40; ++iteration) {
        solver.minimize(step.potential, &x);
        const double energy = step.energyAt(x);
        EXPECT_LE(energy, previous * (1.0 + 1e-12)) << "disorder " << disorder << ", iteration " << iteration;
        previous = energy;
      }
    }
  }
}

TEST(ProjectiveDynamics, EveryWidthAndPrecisionGivesTheSamePath) {
  std::mt19937 random(4);
  Step step;
  step.pullTo(transformed(step.topology.rest_vertices, testing::somePose()), true, &random);
  const Points start = step.topology.rest_vertices + randomPoints(step.count, 0.003, &random);
  for (int history : {0, 5}) {
    ProjectiveDynamicsOptions options = withHistory(history, 10);
    Points reference = start;
    step.run(options, &reference);
    for (Simd simd : {Simd::kSse4, Simd::kAvx2, Simd::kAvx512}) {
      try {
        options.simd = supportedSimd(simd);
      } catch (const std::invalid_argument&) {
        continue;
      }
      for (bool single : {false, true}) {
        options.single_precision = single;
        Points x = start;
        step.run(options, &x);
        EXPECT_LT((x - reference).cwiseAbs().maxCoeff(), single ? 2e-6 : 1e-11)
            << nameOf(simd) << ", history " << history;
      }
    }
  }
}

TEST(ProjectiveDynamics, ReportsConvergenceAndResidual) {
  std::mt19937 random(5);
  Step step;
  step.pullTo(step.topology.rest_vertices + randomPoints(step.count, 0.005, &random), false, &random);
  for (bool single : {false, true}) {
    ProjectiveDynamicsOptions options = withHistory(5, 3);
    options.single_precision = single;
    options.minimizer.tolerance = single ? 1e-4 : 1e-6;
    Points x = step.topology.rest_vertices;
    const StepReport capped = step.run(options, &x);
    EXPECT_FALSE(capped.converged);
    EXPECT_EQ(capped.iterations, 3);
    options.minimizer.max_iterations = 500;
    const StepReport report = step.run(options, &x);
    EXPECT_TRUE(report.converged);
    EXPECT_LT(report.iterations, 200);
    EXPECT_LE(report.residual_n, options.minimizer.tolerance * report.external_n);
    EXPECT_LT(report.residual_n, 0.05 * capped.residual_n);

    Points gradient(step.count, 3);
    step.potential.evaluate(x, &gradient);
    CorotatedElasticity(step.topology.rest_vertices, step.topology.tets, step.lame).addTo(x, &gradient);
    EXPECT_NEAR(report.residual_n, gradient.cwiseAbs().sum(), single ? 1e-1 : 1e-9);
  }
}

TEST(ProjectiveDynamics, RefactorsWhenTargetsChange) {
  std::mt19937 random(6);
  Step step;
  ProjectiveDynamics kept(step.topology, step.lame, withHistory(0, 10));
  for (int frame = 0; frame < 6; ++frame) {
    step.pullTo(step.topology.rest_vertices + randomPoints(step.count, 0.005, &random), frame % 2 == 0,
                &random);
    std::vector<Target> targets = testing::vertexTargets(step.topology, step.topology.rest_vertices);
    if (frame >= 3) {
      for (Target& target : targets) target.weight = frame;
      step.potential.targets.set(targets, step.topology.tets, 300.0);
    }
    Points x = step.topology.rest_vertices, expected = x;
    kept.minimize(step.potential, &x);
    step.run(withHistory(0, 10), &expected);
    EXPECT_LT((x - expected).cwiseAbs().maxCoeff(), 1e-12) << frame;
  }
}

/// Mostly few changes, which update the factor; sometimes more.
TEST(ProjectiveDynamics, HandlesTargetsThatAppearVanishAndChangeWeight) {
  std::mt19937 random(7);
  const auto below = [&random](std::size_t n) { return random() % n; };
  Step step;
  std::vector<Target> all = testing::vertexTargets(
      step.topology, step.topology.rest_vertices + randomPoints(step.count, 0.005, &random));
  std::vector<Target> targets(all.begin(), all.begin() + 60);
  ProjectiveDynamics kept(step.topology, step.lame, withHistory(0, 10));
  for (int frame = 0; frame < 300; ++frame) {
    for (std::size_t change = below(frame % 20 == 0 ? 30 : 5); change > 0; --change) {
      const std::size_t kind = below(3), place = below(targets.size());
      if (kind == 0)
        targets.insert(targets.begin() + static_cast<std::ptrdiff_t>(place), all[below(all.size())]);
      else if (kind == 1 && targets.size() > 20)
        targets.erase(targets.begin() + static_cast<std::ptrdiff_t>(place));
      else
        targets[place].weight = 0.1 + static_cast<double>(below(100));
    }
    step.potential.targets.set(targets, step.topology.tets, 300.0);
    Points x = step.topology.rest_vertices, expected = x;
    kept.minimize(step.potential, &x);
    step.run(withHistory(0, 10), &expected);
    ASSERT_LT((x - expected).cwiseAbs().maxCoeff(), 1e-11) << frame;
  }
}

/// Targets wander over the body, come and go, and the time step changes: L-BFGS with the factor that it kept
/// needs about as many iterations as with a new one, and finds the same minimum.
TEST(ProjectiveDynamics, KeptFactorServesAsWellAsANewOneWithLbfgs) {
  std::mt19937 random(9);
  Step step;
  ProjectiveDynamicsOptions options = withHistory(5, 1000);
  options.minimizer.tolerance = 1e-8;
  ProjectiveDynamics kept(step.topology, step.lame, options);
  int kept_iterations = 0, new_iterations = 0;
  for (int frame = 0; frame < 40; ++frame) {
    const std::size_t count = frame % 10 < 8 ? 100 : 20;
    std::vector<Target> targets = testing::vertexTargets(
        step.topology, step.topology.rest_vertices + randomPoints(step.count, 0.005, &random));
    for (Target& target : targets) target.weight = std::exp(0.1 * frame) * std::abs(target.position.x());
    std::shuffle(targets.begin(), targets.end(), random);
    ASSERT_GT(targets.size(), count);
    targets.resize(count);
    step.potential.targets.set(targets, step.topology.tets, 300.0);
    step.potential.inertia.setConstant(frame % 4 == 0 ? 0.01 : 2.0);
    Points x = step.topology.rest_vertices, expected = x;
    const StepReport report = kept.minimize(step.potential, &x), newly = step.run(options, &expected);
    EXPECT_TRUE(report.converged && newly.converged) << frame;
    EXPECT_LT((x - expected).cwiseAbs().maxCoeff(), 1e-6) << frame;
    kept_iterations += report.iterations;
    new_iterations += newly.iterations;
  }
  EXPECT_LT(kept_iterations, 1.5 * new_iterations);
}

TEST(TargetEnergy, BoundsItsMetricByADiagonal) {
  std::mt19937 random(10);
  const Step step;
  std::vector<Target> targets = testing::vertexTargets(step.topology, step.topology.rest_vertices);
  for (Target& target : targets) {  // some points are outside of their tet
    target.place.barycentric = randomPoints(2, 0.5, &random).reshaped().head<4>();
    target.place.barycentric.array() += 0.25 * (1.0 - target.place.barycentric.sum());
  }
  TargetEnergy energy;
  energy.set(targets, step.topology.tets, 300.0);
  TetMatrix metric(step.topology.tets, step.count);
  energy.addMetric(&metric);
  Eigen::VectorXd bound = Eigen::VectorXd::Zero(step.count);
  energy.addMetricBound(&bound);
  Eigen::MatrixXd rest = -Eigen::MatrixXd(metric.lower());
  rest.diagonal() += bound;
  EXPECT_GT(rest.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), -1e-9 * bound.maxCoeff());
}

TEST(TargetEnergy, ListsTheChangesBetweenTwoMetrics) {
  std::mt19937 random(8);
  const Step step;
  std::vector<Target> targets = testing::vertexTargets(step.topology, step.topology.rest_vertices);
  TargetEnergy before, now;
  before.set(targets, step.topology.tets, 300.0);
  targets[3].weight = 2.0;
  targets.erase(targets.begin() + 10);
  targets.push_back(targets[40]);
  now.set(targets, step.topology.tets, 300.0);
  std::vector<TetVector> added, removed;
  EXPECT_FALSE(now.metricChanges(before, 2, &added, &removed));
  ASSERT_TRUE(now.metricChanges(before, 3, &added, &removed));
  EXPECT_EQ(added.size(), 2u);
  EXPECT_EQ(removed.size(), 1u);

  TetMatrix expected(step.topology.tets, step.count), found = expected;
  before.addMetric(&found);
  now.addMetric(&expected);
  Eigen::MatrixXd difference = expected.lower() - found.lower();
  const auto subtract = [&difference](const TetVector& v, double sign) {
    for (int a = 0; a < 4; ++a) {
      for (int b = 0; b < 4; ++b) {
        if (v.vertices[a] >= v.vertices[b])
          difference(v.vertices[a], v.vertices[b]) -= sign * v.values[a] * v.values[b];
      }
    }
  };
  for (const TetVector& v : added) subtract(v, 1.0);
  for (const TetVector& v : removed) subtract(v, -1.0);
  EXPECT_LT(difference.cwiseAbs().maxCoeff(), 1e-9);
}

}  // namespace
}  // namespace softbody
