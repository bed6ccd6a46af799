#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "prediction/association.h"

namespace softbody {
namespace {

Eigen::Isometry3d smallMotion(std::mt19937* random, double angle, double shift) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const Eigen::Vector3d axis =
      Eigen::Vector3d(uniform(*random), uniform(*random), uniform(*random)).normalized();
  const Eigen::Vector3d direction =
      Eigen::Vector3d(uniform(*random), uniform(*random), uniform(*random)).normalized();
  return Eigen::Translation3d(shift * direction) * Eigen::AngleAxisd(angle, axis);
}

std::vector<Association> randomPoints(std::mt19937* random, int count) {
  std::uniform_real_distribution<double> uniform(-0.1, 0.1);
  std::vector<Association> associations(count);
  for (Association& a : associations)
    a.predicted = {uniform(*random), uniform(*random), 0.5 + uniform(*random)};
  return associations;
}

/// Repeats the step until it has converged, as the tracker does.
Eigen::Isometry3d converge(std::vector<Association> associations) {
  Eigen::Isometry3d total = Eigen::Isometry3d::Identity();
  for (int i = 0; i < 20; ++i) {
    const Eigen::Isometry3d step = rigidStep(refsTo(associations));
    for (Association& a : associations) a.predicted = step * a.predicted;
    total = step * total;
  }
  return total;
}

TEST(RigidStep, RecoversRigidMotionsFromPoints) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 50; ++trial) {
    const Eigen::Isometry3d truth = smallMotion(&random, 0.05, 0.01);
    std::vector<Association> associations = randomPoints(&random, 30);
    for (Association& a : associations) a.measured = truth * a.predicted;
    EXPECT_TRUE(converge(associations).isApprox(truth, 1e-6));
  }
}

TEST(RigidStep, RecoversRigidMotionsFromPlanes) {
  std::mt19937 random(2);
  std::normal_distribution<double> gauss;
  for (int trial = 0; trial < 50; ++trial) {
    const Eigen::Isometry3d truth = smallMotion(&random, 0.02, 0.005);
    std::vector<Association> associations = randomPoints(&random, 200);
    for (Association& a : associations) {
      a.normal = Eigen::Vector3d(gauss(random), gauss(random), gauss(random)).normalized();
      a.measured = truth * a.predicted;
    }
    EXPECT_TRUE(converge(associations).isApprox(truth, 1e-5));
  }
}

TEST(RigidStep, OutliersHardlyCount) {
  std::mt19937 random(3);
  const Eigen::Isometry3d truth = smallMotion(&random, 0.02, 0.005);
  std::vector<Association> associations = randomPoints(&random, 100);
  for (std::size_t i = 0; i < associations.size(); ++i) {
    associations[i].measured = truth * associations[i].predicted;
    if (i % 5 == 0) associations[i].measured += Eigen::Vector3d(0.0, 0.0, 0.2);
  }
  const Eigen::Isometry3d found = converge(associations);
  for (const Association& a : associations) {
    EXPECT_LT((found * a.predicted - truth * a.predicted).norm(), 0.001);
  }
}

TEST(RigidStep, OnePlaneMovesOnlyAlongItsNormal) {
  std::mt19937 random(4);
  std::vector<Association> associations = randomPoints(&random, 100);
  for (Association& a : associations) {
    a.predicted.z() = 0.5;
    a.normal = -Eigen::Vector3d::UnitZ();
    a.measured = a.predicted + Eigen::Vector3d(0.003, 0.0, 0.002);
  }
  const Eigen::Isometry3d found = converge(associations);
  EXPECT_NEAR((found * Eigen::Vector3d(0.0, 0.0, 0.5) - Eigen::Vector3d(0.0, 0.0, 0.502)).norm(), 0.0, 1e-4);
}

/// The median is the scale for outliers; a few tens of samples would be off by a quarter.
TEST(MedianResidual, OfManyIsThatOfEnoughOfThem) {
  constexpr double kMedianOfNormal = 0.6745;  // of the absolute values
  double sum = 0.0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> gauss;
    std::vector<Association> associations(5000);
    for (Association& a : associations) {
      a.normal = Eigen::Vector3d::UnitZ();
      a.measured.z() = 0.01 * gauss(random);
    }
    const double off = medianResidual(refsTo(associations)) / (0.01 * kMedianOfNormal) - 1.0;
    sum += off * off;
  }
  EXPECT_LT(std::sqrt(sum / 20.0), 0.1);
}

TEST(WeighByResidual, LowersWhatIsFarFromTheOthers) {
  std::vector<Association> associations(11);
  for (Association& a : associations) {
    a.normal = Eigen::Vector3d::UnitZ();
    a.measured.z() = 0.002;
  }
  associations[5].measured.z() = 0.008;  // four medians
  weighByResidual(4.0, &associations);
  EXPECT_DOUBLE_EQ(associations[5].weight, 0.5);
  EXPECT_NEAR(associations[0].weight, 16.0 / 17.0, 1e-12);
}

/// Differences of less than the precision of any measurement are no outliers.
TEST(WeighByResidual, DoesNotJudgeTinyResiduals) {
  std::vector<Association> associations(11);
  for (Association& a : associations) a.normal = Eigen::Vector3d::UnitZ();
  associations[5].measured.z() = 0.0005;
  weighByResidual(4.0, &associations);
  EXPECT_GT(associations[5].weight, 0.98);
}

TEST(RigidStep, NothingGivesIdentity) {
  EXPECT_TRUE(rigidStep({}).isApprox(Eigen::Isometry3d::Identity(), 0.0));
  EXPECT_EQ(rmsResidual({}), 0.0);
  EXPECT_EQ(medianResidual({}), 0.0);
}

}  // namespace
}  // namespace softbody
