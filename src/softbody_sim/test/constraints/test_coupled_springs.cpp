#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "constraints/contact_detection.h"
#include "constraints/target_energy.h"
#include "fem/fem_elasticity.h"
#include "fixtures/test_meshes.h"
#include "time_step/packed_potential.h"

namespace softbody {
namespace {

using testing::randomPoints;

/// Springs between random pairs of points on a box; some of a pair share vertices.
class CoupledSprings : public ::testing::Test {
 protected:
  CoupledSprings() { springs_ = someSprings(300.0); }

  TargetEnergy someSprings(double stiffness) {
    std::mt19937 random(5);
    const std::vector<ContactPoint> points = sampleContactPoints(topology_, 0.015);
    std::uniform_int_distribution<std::size_t> any(0, points.size() - 1);
    TargetEnergy springs;
    for (int k = 0; k < 60; ++k) {
      const MaterialPoint a = points[any(random)].place, b = points[any(random)].place;
      const Eigen::Vector3d position = randomPoints(1, 0.03, &random).transpose(),
                            normal = randomPoints(1, 1.0, &random).transpose();
      if (k % 2 == 0)
        springs.addOneSided(a, topology_.tets, position, normal, stiffness);
      else
        springs.addFriction(a, topology_.tets, position, normal, stiffness, stiffness * 0.03);  // some slide
      springs.coupleLast(b, topology_.tets);
    }
    return springs;
  }
  Points gradientAt(const Points& x) const {
    Points gradient = Points::Zero(x.rows(), 3);
    springs_.addTo(x, &gradient);
    return gradient;
  }
  double valueAt(const Points& x) const {
    Points unused = Points::Zero(x.rows(), 3);
    return springs_.addTo(x, &unused);
  }
  Eigen::MatrixXd hessian() const {
    const Points& x = topology_.rest_vertices;
    BlockTetMatrix within(FemElasticity(topology_, Elasticity::kCorotated, {1.0, 1.0}).groups(), x.rows());
    springs_.addHessian(x, &within);
    std::vector<Eigen::Triplet<double>> entries;
    springs_.addCouplings(x, &entries);
    Eigen::SparseMatrix<double> between(3 * x.rows(), 3 * x.rows());
    between.setFromTriplets(entries.begin(), entries.end());
    return Eigen::MatrixXd(within.lower() + between).selfadjointView<Eigen::Lower>();
  }

  const TetTopology topology_ = testing::boxTopology({2, 2, 1}, {0.04, 0.04, 0.02});
  TargetEnergy springs_;
};

TEST_F(CoupledSprings, GradientAndHessianMatchDifferences) {
  const Points& x = topology_.rest_vertices;
  const Eigen::MatrixXd exact = hessian();
  std::mt19937 random(6);
  for (int k = 0; k < 10; ++k) {
    const Points move = 1e-7 * randomPoints(x.rows(), 1.0, &random);
    EXPECT_NEAR((valueAt(x + move) - valueAt(x - move)) / 2.0, gradientAt(x).cwiseProduct(move).sum(), 1e-14);
    const Points difference = (gradientAt(x + move) - gradientAt(x - move)) / 2.0;
    const Eigen::VectorXd product = exact * Eigen::Map<const Eigen::VectorXd>(move.data(), move.size());
    EXPECT_LT((Eigen::Map<const Eigen::VectorXd>(difference.data(), difference.size()) - product).norm(),
              1e-6 * product.norm());
  }
}

TEST_F(CoupledSprings, ForcesOnBothPointsAreOpposite) {
  const Points gradient = gradientAt(topology_.rest_vertices);
  EXPECT_GT(gradient.norm(), 1.0);
  EXPECT_LT(gradient.colwise().sum().norm(), 1e-12 * gradient.norm());
}

TEST_F(CoupledSprings, MetricBoundsTheHessianAndFollowsChanges) {
  const auto metricOf = [&](const TargetEnergy& springs) {
    TetMatrix metric(topology_.tets, topology_.rest_vertices.rows());
    springs.addMetric(&metric);
    return Eigen::MatrixXd(Eigen::MatrixXd(metric.lower()).selfadjointView<Eigen::Lower>());
  };
  const Eigen::MatrixXd metric = metricOf(springs_);
  Eigen::MatrixXd gap = -hessian();
  for (Eigen::Index a = 0; a < metric.rows(); ++a)
    for (Eigen::Index b = 0; b < metric.cols(); ++b)
      gap.block<3, 3>(3 * a, 3 * b) += metric(a, b) * Eigen::Matrix3d::Identity();
  EXPECT_GT(gap.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), -1e-9 * metric.norm());

  const TargetEnergy earlier = someSprings(200.0);
  std::vector<TetVector> added, removed;
  ASSERT_TRUE(springs_.metricChanges(earlier, 1000, &added, &removed));
  Eigen::MatrixXd changed = metricOf(earlier);
  for (const TetVector& vector : added)
    for (int k = 0; k < 16; ++k)
      changed(vector.vertices[k / 4], vector.vertices[k % 4]) += vector.values[k / 4] * vector.values[k % 4];
  EXPECT_TRUE(removed.empty());
  EXPECT_LT((changed - metric).norm(), 1e-12 * metric.norm());
}

/// The kernels in vector registers compute the same, in both precisions.
TEST_F(CoupledSprings, KernelsAgree) {
  const Points& x = topology_.rest_vertices;
  IncrementalPotential potential;
  potential.inertia = Eigen::VectorXd::Zero(x.rows());
  potential.prediction = x;
  potential.loads = Points::Zero(x.rows(), 3);
  potential.targets = springs_;
  const auto expectNear = [&](auto scalar, double tolerance) {
    using T = decltype(scalar);
    PackedPotential<T> packed(x.rows(), Simd::kAuto);
    packed.set(potential, {0.3, -0.2, 0.1});
    Rows<T> rows = Rows<T>::Zero(paddedRows(x.rows()), 4), gradient = rows;
    packed.toRows(x, &rows);
    EXPECT_NEAR(packed.evaluate(rows, &gradient), valueAt(x), tolerance * valueAt(x));
    EXPECT_LT((gradient.topLeftCorner(x.rows(), 3).template cast<double>() - gradientAt(x)).norm(),
              tolerance * gradientAt(x).norm());
  };
  expectNear(0.0, 1e-12);
  expectNear(0.0f, 1e-4);
}

}  // namespace
}  // namespace softbody
