#include <gtest/gtest.h>

#include <functional>

#include "constraints/target_energy.h"
#include "elasticity/corotated_elasticity.h"
#include "fixtures/test_meshes.h"
#include "time_step/incremental_potential.h"

namespace softbody {
namespace {

using testing::boxTopology;
using testing::randomPoints;
using Energy = std::function<double(const Points&, Points*)>;

const Lame kLame{8000.0, 5000.0};

double valueOf(const Energy& energy, const Points& x) {
  Points unused = Points::Zero(x.rows(), 3);
  return energy(x, &unused);
}

/// Compares the directional derivative in random directions with central differences.
void expectGradientMatchesDifferences(const Energy& energy, const Points& x, double step,
                                      std::mt19937* random) {
  Points gradient = Points::Zero(x.rows(), 3);
  energy(x, &gradient);
  for (int k = 0; k < 5; ++k) {
    const Points direction = randomPoints(x.rows(), 1.0, random);
    const double slope = gradient.cwiseProduct(direction).sum();
    const double difference =
        (valueOf(energy, x + step * direction) - valueOf(energy, x - step * direction)) / (2.0 * step);
    EXPECT_NEAR(difference, slope, 1e-6 * (gradient.norm() * direction.norm() + 1e-12));
  }
}

std::vector<Target> someTargets(const TetTopology& topology, bool with_normals, std::mt19937* random) {
  std::vector<Target> targets(40);
  for (std::size_t i = 0; i < targets.size(); ++i) {
    targets[i].place.tet = static_cast<int>((*random)() % static_cast<unsigned>(topology.tets.rows()));
    targets[i].place.barycentric.tail<3>() = 0.6 * randomPoints(1, 1.0, random).transpose();
    targets[i].place.barycentric[0] = 1.0 - targets[i].place.barycentric.tail<3>().sum();
    targets[i].position = randomPoints(1, 0.1, random).transpose();
    if (with_normals) targets[i].normal = randomPoints(1, 1.0, random).transpose().normalized();
    targets[i].weight = 0.5 + 0.1 * static_cast<double>(i % 7);
  }
  return targets;
}

TEST(CorotatedEnergy, StressIsTheDerivative) {
  std::mt19937 random(1);
  for (int k = 0; k < 200; ++k) {
    const Eigen::Matrix3d F = Eigen::Matrix3d::Identity() + 0.4 * randomPoints(3, 1.0, &random);
    const Eigen::Matrix3d D = randomPoints(3, 1.0, &random);
    Eigen::Matrix3d stress, unused;
    corotatedEnergy(F, kLame, &stress);
    const double h = 1e-6;
    const double difference =
        (corotatedEnergy(F + h * D, kLame, &unused) - corotatedEnergy(F - h * D, kLame, &unused)) / (2.0 * h);
    EXPECT_NEAR(difference, stress.cwiseProduct(D).sum(), 1e-5 * kLame.mu) << F;
  }
}

TEST(CorotatedEnergy, IsLinearElasticityForSmallStrains) {
  const double strain = 1e-5;
  Eigen::Matrix3d stress;
  // Uniaxial strain: the modulus is lambda + 2 mu along the strain, lambda across.
  corotatedEnergy(Eigen::Vector3d(1.0 + strain, 1.0, 1.0).asDiagonal(), kLame, &stress);
  EXPECT_NEAR(stress(0, 0), (kLame.lambda + 2.0 * kLame.mu) * strain, 1e-9 * kLame.mu);
  EXPECT_NEAR(stress(1, 1), kLame.lambda * strain, 1e-9 * kLame.mu);
  // Simple shear: mu times the angle.
  Eigen::Matrix3d shear = Eigen::Matrix3d::Identity();
  shear(0, 1) = strain;
  corotatedEnergy(shear, kLame, &stress);
  EXPECT_NEAR(stress(0, 1), kLame.mu * strain, 1e-9 * kLame.mu);
}

TEST(LameParameters, RefuseAnImpossibleMaterial) {
  EXPECT_THROW(lameParameters(0.0, 0.3), std::invalid_argument);
  EXPECT_THROW(lameParameters(1e4, 0.5), std::invalid_argument);
  EXPECT_THROW(lameParameters(1e4, -0.1), std::invalid_argument);
  const Lame lame = lameParameters(2.0e4, 0.25);
  EXPECT_DOUBLE_EQ(lame.mu, 8000.0);
  EXPECT_DOUBLE_EQ(lame.lambda, 8000.0);
}

class Energies : public ::testing::TestWithParam<Smoothing> {
 protected:
  TetTopology topology_ = boxTopology({3, 2, 2}, {0.06, 0.04, 0.05});
  CorotatedElasticity elasticity_{topology_.rest_vertices, topology_.tets, kLame, GetParam()};
  std::mt19937 random_{7};
  Points deformed_ = topology_.rest_vertices + randomPoints(topology_.rest_vertices.rows(), 0.006, &random_);
  Energy elastic_ = [this](const Points& x, Points* gradient) { return elasticity_.addTo(x, gradient); };
};

TEST_P(Energies, ElasticGradientMatchesDifferences) {
  expectGradientMatchesDifferences(elastic_, deformed_, 1e-8, &random_);
}

TEST_P(Energies, RigidMotionCostsNothingAndChangesNothing) {
  EXPECT_NEAR(valueOf(elastic_, transformed(topology_.rest_vertices, testing::somePose())), 0.0, 1e-18);
  const double energy = valueOf(elastic_, deformed_);
  EXPECT_GT(energy, 1e-3);
  EXPECT_NEAR(valueOf(elastic_, transformed(deformed_, testing::somePose())), energy, 1e-10 * energy);
}

TEST_P(Energies, ElasticForcesHaveNoResultantAndNoMoment) {
  Points gradient = Points::Zero(deformed_.rows(), 3);
  elastic_(deformed_, &gradient);
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (Eigen::Index v = 0; v < gradient.rows(); ++v) {
    moment += Eigen::Vector3d(deformed_.row(v)).cross(Eigen::Vector3d(gradient.row(v)));
  }
  EXPECT_LT(gradient.colwise().sum().norm(), 1e-12 * gradient.norm());
  EXPECT_LT(moment.norm(), 1e-10 * gradient.norm());
}

TEST_P(Energies, TargetGradientMatchesDifferences) {
  for (bool with_normals : {false, true}) {
    TargetEnergy targets;
    targets.set(someTargets(topology_, with_normals, &random_), topology_.tets, 300.0);
    const Energy energy = [&](const Points& x, Points* gradient) { return targets.addTo(x, gradient); };
    expectGradientMatchesDifferences(energy, deformed_, 1e-5, &random_);
  }
}

TEST_P(Energies, IncrementalPotentialGradientMatchesDifferences) {
  IncrementalPotential potential{Eigen::VectorXd::LinSpaced(deformed_.rows(), 1.0, 9.0),
                                 topology_.rest_vertices,
                                 randomPoints(deformed_.rows(), 3.0, &random_),
                                 {}};
  potential.targets.set(someTargets(topology_, true, &random_), topology_.tets, 300.0);
  const Energy energy = [&](const Points& x, Points* gradient) { return potential.evaluate(x, gradient); };
  expectGradientMatchesDifferences(energy, deformed_, 1e-8, &random_);
}

TEST_P(Energies, MetricOfPointTargetsIsTheirExactCurvature) {
  TargetEnergy targets;
  targets.set(someTargets(topology_, false, &random_), topology_.tets, 300.0);
  TetMatrix matrix(topology_.tets, deformed_.rows());
  targets.addMetric(&matrix);
  Points before = Points::Zero(deformed_.rows(), 3), after = before;
  const Points move = randomPoints(deformed_.rows(), 1.0, &random_);
  targets.addTo(deformed_, &before);
  targets.addTo(deformed_ + move, &after);
  const Points product = matrix.lower().selfadjointView<Eigen::Lower>() * move;
  EXPECT_LT((after - before - product).norm(), 1e-9 * product.norm());
}

TEST_P(Energies, MetricOfNormalTargetsBoundsTheirCurvature) {
  TargetEnergy targets;
  targets.set(someTargets(topology_, true, &random_), topology_.tets, 300.0);
  TetMatrix matrix(topology_.tets, deformed_.rows());
  targets.addMetric(&matrix);
  for (int k = 0; k < 100; ++k) {
    const Points move = randomPoints(deformed_.rows(), 0.01, &random_);
    Points gradient = Points::Zero(deformed_.rows(), 3);
    const double energy = targets.addTo(deformed_, &gradient);
    const Points product = matrix.lower().selfadjointView<Eigen::Lower>() * move;
    const double bound = energy + gradient.cwiseProduct(move).sum() + 0.5 * move.cwiseProduct(product).sum();
    Points unused = gradient;
    EXPECT_LE(targets.addTo(deformed_ + move, &unused), bound * (1.0 + 1e-12));
  }
}

TEST_P(Energies, ElasticMetricBoundsTheEnergyOfCompressedAndTurnedTets) {
  TetMatrix matrix(topology_.tets, deformed_.rows());
  elasticity_.addMetric(&matrix);
  for (int k = 0; k < 100; ++k) {
    Points gradient = Points::Zero(deformed_.rows(), 3);
    const double energy = elastic_(deformed_, &gradient);
    const Points move = randomPoints(deformed_.rows(), 0.01, &random_);
    const Points product = matrix.lower().selfadjointView<Eigen::Lower>() * move;
    const double bound = energy + gradient.cwiseProduct(move).sum() + 0.5 * move.cwiseProduct(product).sum();
    EXPECT_LE(valueOf(elastic_, deformed_ + move), bound * (1.0 + 1e-12));
  }
}

TEST_P(Energies, RefuseTetsWithoutVolume) {
  std::swap(topology_.tets(5, 0), topology_.tets(5, 1));
  EXPECT_THROW(CorotatedElasticity(topology_.rest_vertices, topology_.tets, kLame, GetParam()),
               std::invalid_argument);
}

/// A uniform strain equals its mean, and forces act only on the boundary.
TEST_P(Energies, UniformStrainHasTheEnergyOfTheWholeBodyAndNoForceInside) {
  const Eigen::Matrix3d F = Eigen::Matrix3d::Identity() + 0.2 * randomPoints(3, 1.0, &random_);
  const Points x = topology_.rest_vertices * F.transpose();
  Eigen::Matrix3d stress;
  const double density = corotatedEnergy(F, kLame, &stress);
  Points gradient = Points::Zero(x.rows(), 3);
  EXPECT_NEAR(elastic_(x, &gradient), 0.06 * 0.04 * 0.05 * density, 1e-9 * density * 1e-4);
  const double force = gradient.rowwise().norm().maxCoeff();
  const Eigen::Array3d size(0.06, 0.04, 0.05);
  int inside = 0;
  for (Eigen::Index v = 0; v < x.rows(); ++v) {
    const Eigen::Array3d p = topology_.rest_vertices.row(v).transpose().array();
    if ((p < 1e-9).any() || (p > size - 1e-9).any()) continue;
    ++inside;
    EXPECT_LT(gradient.row(v).norm(), 1e-10 * force);
  }
  EXPECT_EQ(inside, 2);
}

/// Two pieces of a cut body do not act on each other.
TEST_P(Energies, PiecesTurnFreelyAgainstEachOther) {
  const Eigen::Index count = topology_.rest_vertices.rows();
  Points rest(2 * count, 3);
  rest << topology_.rest_vertices, topology_.rest_vertices;  // face to face, or one in the other: no matter
  Tets tets(2 * topology_.tets.rows(), 4);
  tets << topology_.tets, topology_.tets.array() + static_cast<int>(count);
  const CorotatedElasticity both(rest, tets, kLame, GetParam());
  Points x = rest, gradient = Points::Zero(2 * count, 3);
  x.bottomRows(count) = transformed(topology_.rest_vertices, testing::somePose());
  EXPECT_NEAR(both.addTo(x, &gradient), 0.0, 1e-18);
  x.topRows(count) = deformed_;
  const double one = valueOf(elastic_, deformed_);
  EXPECT_NEAR(both.addTo(x, &gradient), one, 1e-12 * one);
}

INSTANTIATE_TEST_SUITE_P(Smoothing, Energies,
                         ::testing::Values(Smoothing(0.0), Smoothing(0.7), Smoothing(0.7, 1.0),
                                           Smoothing(0.0, 1.0)));

}  // namespace
}  // namespace softbody
