#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <random>
#include <vector>

#include "elasticity/rotation.h"

namespace softbody {
namespace {

Eigen::Matrix3d randomMatrix(std::mt19937* random) {
  std::normal_distribution<double> normal;
  return Eigen::Matrix3d::NullaryExpr([&] { return normal(*random); });
}

Eigen::Matrix3d randomRotation(std::mt19937* random) {
  std::normal_distribution<double> normal;
  return Eigen::Quaterniond(normal(*random), normal(*random), normal(*random), normal(*random))
      .normalized()
      .toRotationMatrix();
}

struct Reference {
  Eigen::Matrix3d R;
  double trace;
  double gap;  ///< sum of the two smallest signed singular values: 0 where R is not unique
};

Reference bySvd(const Eigen::Matrix3d& F) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(F, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double sign = svd.matrixU().determinant() * svd.matrixV().determinant() < 0.0 ? -1.0 : 1.0;
  const Eigen::Vector3d signs(1.0, 1.0, sign), s = svd.singularValues().cwiseProduct(signs);
  return {svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose(), s.sum(), s[1] + s[2]};
}

void expectRotationOf(const Eigen::Matrix3d& F) {
  Eigen::Matrix3d R;
  const double trace = extractRotation(F, &R);
  const double scale = F.norm();
  EXPECT_LT((R.transpose() * R - Eigen::Matrix3d::Identity()).norm(), 1e-8) << F;
  EXPECT_NEAR(R.determinant(), 1.0, 1e-8) << F;
  EXPECT_NEAR(trace, (R.transpose() * F).trace(), 1e-9 * scale) << F;
  const Reference reference = bySvd(F);
  EXPECT_NEAR(trace, reference.trace, 1e-9 * scale) << F;
  if (reference.gap > 1e-2 * scale) {
    EXPECT_LT((R - reference.R).norm(), 1e-7) << F;
  }
}

TEST(Rotation, AgreesWithTheSvdOnRandomMatricesInvertedOnesIncluded) {
  std::mt19937 random(1);
  int inverted = 0;
  for (int k = 0; k < 20000; ++k) {
    const Eigen::Matrix3d F = randomMatrix(&random);
    inverted += F.determinant() < 0.0;
    expectRotationOf(F);
  }
  EXPECT_GT(inverted, 9000);
}

TEST(Rotation, AgreesWithTheSvdFromSmallToLargeStrains) {
  std::mt19937 random(2);
  for (double strain : {0.0, 1e-12, 1e-8, 1e-4, 1e-2, 0.3, 3.0}) {
    for (int k = 0; k < 200; ++k) {
      expectRotationOf(randomRotation(&random) *
                       (Eigen::Matrix3d::Identity() + strain * randomMatrix(&random)));
    }
  }
}

TEST(Rotation, IsAccurateAtAnyScale) {
  std::mt19937 random(3);
  for (double scale : {1e-30, 1e-6, 1e6, 1e30}) {
    for (int k = 0; k < 100; ++k) expectRotationOf(scale * randomMatrix(&random));
  }
}

TEST(Rotation, OfDegenerateMatricesIsOneOfTheBestRotations) {
  std::mt19937 random(4);
  const std::vector<Eigen::Vector3d> singular_values = {
      {0, 0, 0},       {1, 0, 0}, {1, 1, 0}, {1, 1e-9, 0}, {1, 1, -1}, {1, 0.5, -0.5}, {1, 0.3, -0.3 + 1e-10},
      {2, 1e-5, -1e-5}};
  for (const Eigen::Vector3d& s : singular_values) {
    for (int k = 0; k < 100; ++k) {
      expectRotationOf(randomRotation(&random) * s.asDiagonal() * randomRotation(&random).transpose());
    }
  }
}

TEST(Rotation, RotatesWithTheBody) {
  std::mt19937 random(5);
  for (int k = 0; k < 1000; ++k) {
    const Eigen::Matrix3d F = Eigen::Matrix3d::Identity() + 0.2 * randomMatrix(&random),
                          Q = randomRotation(&random);
    Eigen::Matrix3d R, R_turned;
    EXPECT_NEAR(extractRotation(F, &R), extractRotation(Q * F, &R_turned), 1e-10);
    EXPECT_LT((Q * R - R_turned).norm(), 1e-8);
  }
}

}  // namespace
}  // namespace softbody
