#include <gtest/gtest.h>

#include <numeric>

#include "fixtures/scene_fixtures.h"
#include "fixtures/solid_fixtures.h"
#include "softbody_common/geometry/tet_geometry.h"

namespace softbody::virtual_camera {
namespace {

const StableNeoHookean kMaterial(kModulus_pa, kPoissonRatio);

/// A deformation with large stretch, shear and rotation.
Eigen::Matrix3d someGradient() {
  Eigen::Matrix3d F;
  F << 1.2, 0.3, -0.1, -0.2, 0.8, 0.25, 0.15, -0.3, 1.05;
  return F;
}

TEST(StableNeoHookean, HasNoEnergyAndNoStressAtRestAlsoTurned) {
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  for (const Eigen::Matrix3d& F : {Eigen::Matrix3d(Eigen::Matrix3d::Identity()), turn}) {
    EXPECT_NEAR(kMaterial.energy(F), 0.0, 1e-10);
    EXPECT_LT(kMaterial.stress(F).norm(), 1e-10);
  }
}

TEST(StableNeoHookean, StressAndStiffnessAreDerivatives) {
  constexpr double kStep = 1e-5;
  const Eigen::Matrix3d F = someGradient();
  const StableNeoHookean::Matrix9 stiffness = kMaterial.stiffnessOf(F, false);
  for (int k = 0; k < 9; ++k) {
    Eigen::Matrix3d more = F, less = F;
    more.data()[k] += kStep;
    less.data()[k] -= kStep;
    EXPECT_NEAR((kMaterial.energy(more) - kMaterial.energy(less)) / (2.0 * kStep),
                kMaterial.stress(F).data()[k], 1e-5);
    const Eigen::Matrix3d change = (kMaterial.stress(more) - kMaterial.stress(less)) / (2.0 * kStep);
    for (int i = 0; i < 9; ++i) EXPECT_NEAR(change.data()[i], stiffness(i, k), 1e-4);
  }
}

TEST(StableNeoHookean, SmallStrainsFollowHookesLaw) {
  Eigen::Matrix3d strain;
  strain << 2e-7, 1e-7, 0, 1e-7, -1e-7, 3e-7, 0, 3e-7, 1e-7;
  const double mu = kModulus_pa / (2.0 * (1.0 + kPoissonRatio));
  const double lambda = 2.0 * mu * kPoissonRatio / (1.0 - 2.0 * kPoissonRatio);
  const Eigen::Matrix3d expected = 2.0 * mu * strain + lambda * strain.trace() * Eigen::Matrix3d::Identity();
  EXPECT_LT((kMaterial.stress(Eigen::Matrix3d::Identity() + strain) - expected).norm(),
            1e-5 * expected.norm());
}

TEST(StableNeoHookean, PositiveStiffnessHasNoNegativeEigenvalue) {
  const Eigen::Matrix3d crushed = Eigen::Vector3d(0.3, 0.4, 0.9).asDiagonal();
  const auto least = [&](bool positive) {
    const StableNeoHookean::Matrix9 stiffness = kMaterial.stiffnessOf(crushed, positive);
    return Eigen::SelfAdjointEigenSolver<StableNeoHookean::Matrix9>(stiffness).eigenvalues().minCoeff();
  };
  EXPECT_LT(least(false), -1.0);
  EXPECT_GT(least(true), -1e-8);
}

TEST(CellGrid, FillsABoxExactlyAndAnimalsNearly) {
  const auto volume = [](const CellGrid& grid) {
    double sum = 0.0;
    for (const auto& cell : grid.volumes) sum = std::accumulate(cell.begin(), cell.end(), sum);
    return sum;
  };
  const CellGrid of_bar = fillWithCells(bar(), 0.01);
  EXPECT_EQ(of_bar.cells.size(), 800u);
  EXPECT_EQ(of_bar.nodes.rows(), 21 * 11 * 5);
  EXPECT_NEAR(volume(of_bar), 0.2 * 0.1 * 0.04, 1e-12);
  const TriangleMesh doll = shippedBody("doll").rest;
  const double expected = enclosedVolume(doll.vertices, doll.triangles);
  EXPECT_NEAR(volume(fillWithCells(doll, 0.01)), expected, 0.01 * expected);
}

TEST(CellGrid, EmbedsEveryVertexAtItsPlace) {
  for (const char* name : {"sponge", "doll"}) {
    const Points& vertices = shippedBody(name).rest.vertices;
    const CellGrid grid = fillWithCells(shippedBody(name).rest, 0.01);
    for (Eigen::Index i = 0; i < vertices.rows(); i += 7) {
      const Embedding place = grid.embed(vertices.row(i));
      EXPECT_LT((place.in(grid.nodes) - vertices.row(i).transpose()).norm(), 1e-12);
      for (const double weight : place.weights) EXPECT_GT(weight, -0.4) << name;
    }
  }
}

TEST(HexSolid, NodalVolumesHaveTheBodysVolumeAndItsMiddle) {
  const HexSolid solid = solidOf(bar(), 0.01);
  const Eigen::VectorXd volumes = solid.nodalVolumes();
  EXPECT_NEAR(volumes.sum(), 0.2 * 0.1 * 0.04, 1e-12);
  EXPECT_LT((solid.grid().nodes.transpose() * volumes).norm(), 1e-12);
  EXPECT_NEAR(volumes.minCoeff(), 1e-6 / 8.0, 1e-12);  // a corner has an eighth of a cell
  EXPECT_NEAR(volumes.maxCoeff(), 1e-6, 1e-12);
}

TEST(HexSolid, GradientAndStiffnessAreDerivatives) {
  constexpr double kStep = 1e-6;
  const HexSolid solid = solidOf(box({0.02, 0.02, 0.01}), 0.01);
  Eigen::VectorXd nodes = deformed(solid, someGradient());
  for (Eigen::Index i = 0; i < nodes.size(); ++i) nodes[i] += 1e-3 * std::sin(7.0 * static_cast<double>(i));
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(nodes.size());
  solid.addGradient(nodes, &gradient);
  Triplets triplets;
  solid.addStiffness(nodes, false, &triplets);
  Eigen::SparseMatrix<double> stiffness(nodes.size(), nodes.size());
  stiffness.setFromTriplets(triplets.begin(), triplets.end());
  for (Eigen::Index i = 0; i < nodes.size(); ++i) {
    Eigen::VectorXd more = nodes, less = nodes;
    more[i] += kStep;
    less[i] -= kStep;
    EXPECT_NEAR((solid.energy(more) - solid.energy(less)) / (2.0 * kStep), gradient[i],
                1e-6 * gradient.norm());
    Eigen::VectorXd change = Eigen::VectorXd::Zero(nodes.size());
    solid.addGradient(less, &change);
    change = -change;
    solid.addGradient(more, &change);
    change /= 2.0 * kStep;
    const Eigen::VectorXd column =
        stiffness.selfadjointView<Eigen::Lower>() * Eigen::VectorXd::Unit(nodes.size(), i);
    EXPECT_LT((change - column).norm(), 1e-5 * column.norm());
  }
}

}  // namespace
}  // namespace softbody::virtual_camera
