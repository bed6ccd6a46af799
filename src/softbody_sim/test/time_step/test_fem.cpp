#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <cmath>

#include "elasticity/corotated_elasticity.h"
#include "fem/fem_elasticity.h"
#include "fixtures/test_meshes.h"
#include "softbody_common/geometry/tet_geometry.h"
#include "time_step/fem_solver.h"

namespace softbody {
namespace {

using testing::boxTopology;
using testing::randomPoints;

const Lame kLame{8000.0, 5000.0};

struct Case {
  std::string name;
  Elasticity elasticity;
  Smoothing smoothing;
};

/// Properties of every elastic energy.
class FemEnergies : public ::testing::TestWithParam<Case> {
 protected:
  double valueOf(const Points& x) const {
    Points unused = Points::Zero(x.rows(), 3);
    return elasticity_.addTo(x, &unused);
  }
  Points gradientAt(const Points& x) const {
    Points gradient = Points::Zero(x.rows(), 3);
    elasticity_.addTo(x, &gradient);
    return gradient;
  }
  Eigen::MatrixXd hessianAt(const Points& x, bool project) const {
    BlockTetMatrix matrix(elasticity_.groups(), x.rows());
    elasticity_.addHessian(x, &matrix, project);
    return Eigen::MatrixXd(matrix.lower()).selfadjointView<Eigen::Lower>();
  }

  TetTopology topology_ = boxTopology({3, 2, 2}, {0.06, 0.04, 0.05});
  FemElasticity elasticity_{topology_, GetParam().elasticity, kLame, GetParam().smoothing};
  std::mt19937 random_{7};
  Points deformed_ = topology_.rest_vertices + randomPoints(topology_.rest_vertices.rows(), 0.006, &random_);
};

TEST_P(FemEnergies, GradientMatchesDifferences) {
  for (double disorder : {0.0, 0.006, 0.02}) {  // the last one inverts tets
    const Points x = topology_.rest_vertices + randomPoints(deformed_.rows(), disorder, &random_);
    const Points gradient = gradientAt(x);
    for (int k = 0; k < 5; ++k) {
      const Points move = 1e-8 * randomPoints(x.rows(), 1.0, &random_);
      EXPECT_NEAR((valueOf(x + move) - valueOf(x - move)) / 2.0, gradient.cwiseProduct(move).sum(),
                  1e-5 * gradient.norm() * move.norm() + 1e-15);
    }
  }
}

TEST_P(FemEnergies, HessianMatchesDifferences) {
  for (double disorder : {0.0, 0.006, 0.02}) {
    const Points x = topology_.rest_vertices + randomPoints(deformed_.rows(), disorder, &random_);
    const Eigen::MatrixXd hessian = hessianAt(x, false);
    for (int k = 0; k < 5; ++k) {
      const Points move = 1e-8 * randomPoints(x.rows(), 1.0, &random_);
      const Points difference = (gradientAt(x + move) - gradientAt(x - move)) / 2.0;
      const Eigen::VectorXd product = hessian * Eigen::Map<const Eigen::VectorXd>(move.data(), move.size());
      EXPECT_LT((Eigen::Map<const Eigen::VectorXd>(difference.data(), difference.size()) - product).norm(),
                1e-5 * product.norm());
    }
  }
}

TEST_P(FemEnergies, ProjectedHessianIsPositiveSemidefiniteAndExactAtRest) {
  const auto smallest = [](const Eigen::MatrixXd& matrix) {
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix).eigenvalues()[0];
  };
  const Eigen::MatrixXd rest = hessianAt(topology_.rest_vertices, false);
  EXPECT_LT((hessianAt(topology_.rest_vertices, true) - rest).norm(), 1e-9 * rest.norm());
  const Points compressed = 0.6 * topology_.rest_vertices;
  EXPECT_LT(smallest(hessianAt(compressed, false)), -1.0);
  for (const Points& x : {compressed, deformed_, Points(-topology_.rest_vertices)})
    EXPECT_GT(smallest(hessianAt(x, true)), -1e-9 * rest.norm());
}

TEST_P(FemEnergies, RigidMotionCostsNothingAndChangesNothing) {
  EXPECT_NEAR(valueOf(transformed(topology_.rest_vertices, testing::somePose())), 0.0, 1e-16);
  const double energy = valueOf(deformed_);
  EXPECT_GT(energy, 1e-3);
  EXPECT_NEAR(valueOf(transformed(deformed_, testing::somePose())), energy, 1e-10 * energy);
}

TEST_P(FemEnergies, ForcesHaveNoResultantAndNoMoment) {
  const Points gradient = gradientAt(deformed_);
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (Eigen::Index v = 0; v < gradient.rows(); ++v)
    moment += Eigen::Vector3d(deformed_.row(v)).cross(Eigen::Vector3d(gradient.row(v)));
  EXPECT_LT(gradient.colwise().sum().norm(), 1e-12 * gradient.norm());
  EXPECT_LT(moment.norm(), 1e-10 * gradient.norm());
}

INSTANTIATE_TEST_SUITE_P(Elasticity, FemEnergies,
                         ::testing::Values(Case{"Corotated", Elasticity::kCorotated, {}},
                                           Case{"NeoHookean", Elasticity::kNeoHookean, {}},
                                           Case{"Springs", Elasticity::kSprings, {}},
                                           Case{"CorotatedSmoothed", Elasticity::kCorotated, {0.7, 1.0}},
                                           Case{"NeoHookeanSmoothed", Elasticity::kNeoHookean, {0.7, 1.0}}),
                         [](const auto& info) { return info.param.name; });

TEST(FemElasticity, IsLinearElasticityForSmallStrains) {
  // Uniaxial strain: the modulus is lambda + 2 mu along the strain, lambda across.
  constexpr double kStrain = 1e-6;
  for (const Elasticity elasticity : {Elasticity::kCorotated, Elasticity::kNeoHookean}) {
    const IsotropicEnergy density = isotropicEnergy(elasticity, {1.0 + kStrain, 1.0, 1.0}, kLame);
    const IsotropicEnergy rest = isotropicEnergy(elasticity, {1.0, 1.0, 1.0}, kLame);
    EXPECT_NEAR(density.gradient[0] / kStrain, kLame.lambda + 2.0 * kLame.mu, 1e-4 * kLame.mu);
    EXPECT_NEAR(density.gradient[1] / kStrain, kLame.lambda, 1e-4 * kLame.mu);
    EXPECT_NEAR(rest.flip[0], 2.0 * kLame.mu, 1e-9 * kLame.mu);
    EXPECT_NEAR(rest.twist[0], 0.0, 1e-9 * kLame.mu);
  }
}

TEST(FemElasticity, OfSpringsIsTheirEnergyByLength) {
  const TetTopology topology = testing::sponge();
  const double youngs_modulus = 2e4;
  std::mt19937 random(4);
  const Points& rest = topology.rest_vertices;
  const Points x = rest + randomPoints(rest.rows(), 0.005, &random);
  const Eigen::VectorXd volumes = tetVolumes(rest, topology.tets);
  double energy = 0.0;
  for (Eigen::Index t = 0; t < topology.tets.rows(); ++t) {
    for (int a = 0; a < 4; ++a) {
      for (int b = 0; b < a; ++b) {
        const int from = topology.tets(t, a), to = topology.tets(t, b);
        const double length = (rest.row(from) - rest.row(to)).norm(), now = (x.row(from) - x.row(to)).norm();
        energy += 0.5 * youngs_modulus * volumes[t] / (length * length) * std::pow(now - length, 2);
      }
    }
  }
  Points gradient = Points::Zero(x.rows(), 3);
  const FemElasticity springs(topology, Elasticity::kSprings, lameParameters(youngs_modulus, 0.3));
  EXPECT_NEAR(springs.addTo(x, &gradient), energy, 1e-9 * energy);
}

TEST(FemElasticity, WithoutABulkTermNothingIsSmoothed) {
  const TetTopology topology = testing::sponge();
  std::mt19937 random(5);
  const Points x = topology.rest_vertices + randomPoints(topology.rest_vertices.rows(), 0.002, &random);
  const Lame no_bulk = lameParameters(2e4, 0.0);
  for (const Elasticity elasticity : {Elasticity::kCorotated, Elasticity::kNeoHookean}) {
    Points smoothed = Points::Zero(x.rows(), 3), plain = smoothed;
    const double energy = FemElasticity(topology, elasticity, no_bulk, {0.0, 0.7}).addTo(x, &smoothed);
    EXPECT_EQ(energy, FemElasticity(topology, elasticity, no_bulk, {0.0, 0.0}).addTo(x, &plain));
    EXPECT_GT(energy, 0.0);
    EXPECT_EQ(smoothed, plain);
  }
}

TEST(FemElasticity, IsTheEnergyOfProjectiveDynamics) {
  std::mt19937 random(3);
  const TetTopology topology = testing::sponge();
  for (const Smoothing& smoothing :
       {Smoothing(0.0), Smoothing(0.7), Smoothing(0.7, 1.0), Smoothing(0.0, 1.0)}) {
    const FemElasticity fem(topology, Elasticity::kCorotated, kLame, smoothing);
    const CorotatedElasticity pd(topology.rest_vertices, topology.tets, kLame, smoothing);
    for (double disorder : {0.001, 0.01, 0.05}) {
      const Points x =
          topology.rest_vertices + randomPoints(topology.rest_vertices.rows(), disorder, &random);
      Points fem_gradient = Points::Zero(x.rows(), 3), pd_gradient = fem_gradient;
      const double energy = pd.addTo(x, &pd_gradient);
      EXPECT_NEAR(fem.addTo(x, &fem_gradient), energy, 1e-9 * energy);
      EXPECT_LT((fem_gradient - pd_gradient).norm(), 1e-7 * pd_gradient.norm());
    }
  }
}

TEST(FemSolver, NewtonConvergesQuadratically) {
  const TetTopology topology = testing::sponge();
  const Eigen::Index count = topology.rest_vertices.rows();
  IncrementalPotential potential{
      Eigen::VectorXd::Constant(count, 0.5), topology.rest_vertices, Points::Zero(count, 3), {}};
  Points goal = topology.rest_vertices;
  goal.col(2) += 3.0 * goal.col(0).cwiseAbs2();  // a bend
  potential.targets.set(testing::vertexTargets(topology, goal), topology.tets, 30.0);
  const auto gradientAfter = [&](int iterations) {
    FemSolver solver(topology, Elasticity::kNeoHookean, {lameParameters(2e4, 0.3), {0.7, 1.0}},
                     {iterations, 0.0});
    Points x = topology.rest_vertices, gradient(count, 3);
    solver.minimize(potential, &x);
    potential.evaluate(x, &gradient);
    solver.addElasticity(x, &gradient);
    return gradient.norm();
  };
  int iterations = 1;
  while (gradientAfter(iterations) > 1e-4 * gradientAfter(0)) ++iterations;
  EXPECT_LT(iterations, 12);
  EXPECT_LT(gradientAfter(iterations + 2), 1e-10 * gradientAfter(0));
}

}  // namespace
}  // namespace softbody
