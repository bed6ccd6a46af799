#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "random_meshes.h"
#include "softbody_common/geometry/rigid_fit.h"

namespace softbody {
namespace {

Points randomPoints(int count, std::mt19937* random) {
  Points points(count, 3);
  for (int i = 0; i < count; ++i) points.row(i) = randomPoint(-0.3, 0.3, random);
  return points;
}

double cost(const Points& source, const Points& target, const Eigen::VectorXd& weights,
            const Eigen::Isometry3d& T) {
  return weights.dot((transformed(source, T) - target).rowwise().squaredNorm());
}

class RigidFit : public testing::TestWithParam<unsigned> {
 protected:
  std::mt19937 random_{GetParam()};
};
INSTANTIATE_TEST_SUITE_P(Seeds, RigidFit, testing::Range(0u, 20u));

TEST_P(RigidFit, RecoversTheMotion) {
  const Points source = randomPoints(3 + static_cast<int>(GetParam()), &random_);
  const Eigen::Isometry3d T = randomMotion(&random_);
  EXPECT_TRUE(fitRigid(source, transformed(source, T)).isApprox(T, 1e-9));
}

TEST_P(RigidFit, PlanarPointsHaveOneAnswerToo) {
  Points source = randomPoints(10, &random_);
  source.col(2).setZero();
  const Eigen::Isometry3d T = randomMotion(&random_);
  EXPECT_TRUE(fitRigid(source, transformed(source, T)).isApprox(T, 1e-9));
}

TEST_P(RigidFit, NeverReflects) {
  const Points source = randomPoints(12, &random_);
  Points mirrored = transformed(source, randomMotion(&random_));
  mirrored.col(1) *= -1.0;
  for (const Points& target :
       {mirrored, Points(Points::Zero(12, 3)), Points(source.row(0).replicate(12, 1))}) {
    const Eigen::Isometry3d T = fitRigid(source, target);
    EXPECT_NEAR(T.linear().determinant(), 1.0, 1e-9);
    EXPECT_TRUE((T.linear() * T.linear().transpose()).isIdentity(1e-9));
  }
}

TEST_P(RigidFit, NoMotionNearbyIsBetter) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const Points source = randomPoints(15, &random_), target = randomPoints(15, &random_);
  const Eigen::VectorXd weights =
      Eigen::VectorXd::NullaryExpr(15, [&](Eigen::Index) { return uniform(random_); });
  const Eigen::Isometry3d best = fitRigid(source, target, weights);
  for (int trial = 0; trial < 50; ++trial) {
    Eigen::Isometry3d nudge = Eigen::Isometry3d::Identity();
    nudge.translation() = randomPoint(-1e-3, 1e-3, &random_);
    nudge.rotate(Eigen::AngleAxisd(1e-3 * uniform(random_), randomPoint(-1.0, 1.0, &random_).normalized()));
    EXPECT_LE(cost(source, target, weights, best), cost(source, target, weights, best * nudge) + 1e-15);
  }
}

TEST_P(RigidFit, AWeightOfTwoIsAPointTwiceAndOfZeroNone) {
  const Points source = randomPoints(6, &random_), target = randomPoints(6, &random_);
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(6);
  weights[0] = 2.0;
  weights[5] = 0.0;
  Points source_rows(6, 3), target_rows(6, 3);
  source_rows << source.topRows(5), source.row(0);
  target_rows << target.topRows(5), target.row(0);
  EXPECT_TRUE(fitRigid(source, target, weights).isApprox(fitRigid(source_rows, target_rows), 1e-9));
}

TEST(RigidFitErrors, BadInputIsRefused) {
  const Points two = Points::Random(2, 3), three = Points::Random(3, 3);
  Points broken = three;
  broken(1, 1) = NAN;
  EXPECT_THROW(fitRigid(two, three), std::invalid_argument);
  EXPECT_THROW(fitRigid(three, broken), std::invalid_argument);
  EXPECT_THROW(fitRigid(three, three, Eigen::VectorXd::Ones(2)), std::invalid_argument);
  EXPECT_THROW(fitRigid(three, three, Eigen::VectorXd::Zero(3)), std::invalid_argument);
  EXPECT_THROW(fitRigid(three, three, Eigen::Vector3d(1.0, -1.0, 1.0)), std::invalid_argument);
  EXPECT_THROW(fitRigid(Points(0, 3), Points(0, 3)), std::invalid_argument);
}

}  // namespace
}  // namespace softbody
