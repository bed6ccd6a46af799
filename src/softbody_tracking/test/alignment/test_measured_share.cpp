#include "alignment/measured_share.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

namespace softbody {
namespace {

/// The corners of a cube of 0.2 m.
Points measuredCube() {
  Points points(8, 3);
  for (int i = 0; i < 8; ++i) points.row(i) = 0.2 * Eigen::RowVector3d(i & 1, i >> 1 & 1, i >> 2 & 1);
  return points;
}

/// Each corner measured along some directions.
std::vector<Association> measured(const std::vector<Eigen::Vector3d>& directions, double weight = 1.0) {
  std::vector<Association> result;
  const Points corners = measuredCube();
  for (const auto& corner : corners.rowwise()) {
    for (const Eigen::Vector3d& direction : directions) {
      Association a;
      a.predicted = a.measured = corner;
      a.normal = direction;
      a.weight = weight;
      result.push_back(a);
    }
  }
  return result;
}

const Eigen::Matrix3d kNoTurn = Eigen::Matrix3d::Identity();
const Eigen::Vector3d kX = Eigen::Vector3d::UnitX(), kY = Eigen::Vector3d::UnitY(),
                      kZ = Eigen::Vector3d::UnitZ();

MotionShare shareOf(const std::vector<Association>& associations, const Eigen::Matrix3d& R = kNoTurn) {
  return measuredShares(associations, {measuredCube()}, R).front();
}

/// (spin, velocity) of a shift.
Eigen::Matrix<double, 6, 1> shift(const Eigen::Vector3d& velocity) {
  Eigen::Matrix<double, 6, 1> motion = Eigen::Matrix<double, 6, 1>::Zero();
  motion.tail<3>() = velocity;
  return motion;
}

TEST(MeasuredShare, KeepsWhatIsMeasuredInAllDirections) {
  const MotionShare share = shareOf(measured({kX, kY, kZ}));
  EXPECT_LT((share - MotionShare::Identity()).norm(), 0.4);
  EXPECT_GT((share * shift(kX)).norm(), 0.85);
}

TEST(MeasuredShare, AnAssociationWithoutNormalMeasuresAllDirections) {
  EXPECT_TRUE(shareOf(measured({Eigen::Vector3d::Zero()})).isApprox(shareOf(measured({kX, kY, kZ})), 1e-9));
}

TEST(MeasuredShare, DropsAShiftThatNothingMeasures) {
  const MotionShare share = shareOf(measured({kY, kZ}));
  EXPECT_LT((share * shift(kX)).norm(), 1e-9);
  EXPECT_GT((share * shift(kY)).norm(), 0.85);
  EXPECT_TRUE(shareOf({}).isZero(0.0));
}

/// Eight corners of weight w measure a shift to the standard deviation 1 mm / sqrt(8 w).
TEST(MeasuredShare, GrowsWithThePrecisionOfTheMeasurement) {
  for (const double weight : {0.001, 0.125, 1.0, 50.0}) {
    const double variance = 1.0 / (8.0 * weight);  // [mm^2]
    const MotionShare share = shareOf(measured({kX, kY, kZ}, weight));
    EXPECT_LT((share * shift(kX) - shift(kX) / (1.0 + variance)).norm(), 1e-9) << weight;
  }
}

TEST(MeasuredShare, TurnsIntoTheFixedFrame) {
  const Eigen::Matrix3d R = Eigen::AngleAxisd(0.5 * M_PI, kZ).toRotationMatrix();  // camera x is fixed y
  const MotionShare share = shareOf(measured({kY, kZ}), R);
  EXPECT_LT((share * shift(kY)).norm(), 1e-9);
  EXPECT_GT((share * shift(kX)).norm(), 0.85);
}

TEST(MeasuredShare, PiecesHaveTheirOwn) {
  std::vector<Association> both = measured({kX, kY, kZ});
  for (Association a : measured({kY})) {
    a.piece = 1;
    both.push_back(a);
  }
  const std::vector<MotionShare> shares = measuredShares(both, {measuredCube(), measuredCube()}, kNoTurn);
  EXPECT_GT((shares[0] * shift(kX)).norm(), 0.85);
  EXPECT_LT((shares[1] * shift(kX)).norm(), 1e-9);
}

}  // namespace
}  // namespace softbody
