#include <gtest/gtest.h>
#include <hwy/highway.h>

#include "bench/doll_size.h"
#include "bench/mean_value_reference.h"
#include "fixtures/test_meshes.h"
#include "softbody_sim/mean_value/mean_value_coordinates.h"

namespace softbody {
namespace {

WeightRows meanValueCoordinates(const Points& points, const Points& cage_vertices,
                                const Triangles& cage_triangles) {
  WeightRows weights;
  MeanValueCage(cage_vertices, cage_triangles).coordinates(points, &weights);
  return weights;
}

class MeanValueCoordinates : public ::testing::Test {
 protected:
  MeanValueCoordinates() {
    // A box with a notch and bumps: neither convex nor smooth, some neighbouring faces coplanar.
    cage_ = testing::boxTopology({4, 3, 2}, {0.2, 0.12, 0.08});
    for (Eigen::Index v = 0; v < cage_.rest_vertices.rows(); ++v) {
      if (cage_.rest_vertices(v, 2) > 0.079 && v % 3 == 0) cage_.rest_vertices(v, 2) -= 0.03;
    }
  }
  WeightRows weightsOf(const Points& points) const {
    return meanValueCoordinates(points, cage_.rest_vertices, cage_.surface);
  }
  void expectReproduces(const Points& points, double tolerance) const {
    const WeightRows weights = weightsOf(points);
    EXPECT_LT((weights.rowwise().sum().array() - 1.0).abs().maxCoeff(), 1e-12);
    EXPECT_LT((weights * cage_.rest_vertices - points).cwiseAbs().maxCoeff(), tolerance);
  }
  /// Random points in random tets, or on their boundary triangles if `corners` is 3, on its edges if 2.
  Points randomPointsOf(int corners, int count) {
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    Points points(count, 3);
    for (int p = 0; p < count; ++p) {
      Eigen::Vector4d b = Eigen::Vector4d::Zero();
      for (int k = 0; k < corners; ++k) b[k] = uniform(random_);
      b /= b.sum();
      points.row(p).setZero();
      const auto row = static_cast<Eigen::Index>(
          random_() % static_cast<unsigned>(corners == 4 ? cage_.tets.rows() : cage_.surface.rows()));
      for (int k = 0; k < corners; ++k) {
        points.row(p) +=
            b[k] * cage_.rest_vertices.row(corners == 4 ? cage_.tets(row, k) : cage_.surface(row, k));
      }
    }
    return points;
  }
  TetTopology cage_;
  std::mt19937 random_{1};
};

TEST_F(MeanValueCoordinates, SumToOneAndReproducePointsInside) {
  expectReproduces(randomPointsOf(4, 500), 1e-11);
}

TEST_F(MeanValueCoordinates, SumToOneAndReproducePointsOutside) {
  Points points = testing::randomPoints(200, 0.3, &random_);
  expectReproduces(points, 1e-9);
}

TEST_F(MeanValueCoordinates, AreLinearOnFacesEdgesAndVertices) {
  for (int corners : {1, 2, 3}) {
    const Points points = randomPointsOf(corners, 300);
    expectReproduces(points, 1e-11);
    const WeightRows weights = weightsOf(points);
    // Only the corners of the triangle with the point have non-zero weights.
    for (Eigen::Index p = 0; p < points.rows(); ++p) {
      EXPECT_LE((weights.row(p).array().abs() > 1e-6).count(), corners);
      EXPECT_GT(weights.row(p).minCoeff(), -1e-9);
    }
  }
}

TEST_F(MeanValueCoordinates, AreContinuousTowardsTheSurface) {
  const Points normals_at = randomPointsOf(3, 200);
  const WeightRows on_surface = weightsOf(normals_at);
  for (double distance : {1e-6, 1e-8, 1e-10, 1e-12, 1e-14}) {
    const Points near = normals_at + distance * testing::randomPoints(normals_at.rows(), 1.0, &random_);
    EXPECT_LT((weightsOf(near) - on_surface).cwiseAbs().maxCoeff(), 1e4 * distance + 1e-6) << distance;
  }
  // The same at edges and vertices, where faces meet.
  for (int corners : {1, 2}) {
    const Points points = randomPointsOf(corners, 200);
    const WeightRows weights = weightsOf(points);
    for (double distance : {1e-7, 1e-9, 1e-11, 1e-13}) {
      const Points near = points + distance * testing::randomPoints(points.rows(), 1.0, &random_);
      EXPECT_LT((weightsOf(near) - weights).cwiseAbs().maxCoeff(), 1e5 * distance + 1e-4)
          << corners << " " << distance;
    }
  }
}

TEST_F(MeanValueCoordinates, MoveWithTheirFrame) {
  const Points points = randomPointsOf(4, 100);
  const Eigen::Isometry3d T = testing::somePose();
  const WeightRows moved =
      meanValueCoordinates(transformed(points, T), transformed(cage_.rest_vertices, T), cage_.surface);
  EXPECT_LT((moved - weightsOf(points)).cwiseAbs().maxCoeff(), 1e-9);
}

TEST_F(MeanValueCoordinates, ArePositiveInAConvexCage) {
  cage_ = testing::boxTopology({1, 1, 1}, {0.1, 0.1, 0.1});
  EXPECT_GT(weightsOf(randomPointsOf(4, 300)).minCoeff(), 0.0);
}

TEST_F(MeanValueCoordinates, WindingNumberTellsInsideFromOutside) {
  const MeanValueCage cage(cage_.rest_vertices, cage_.surface);
  const TetLocator locator(cage_.rest_vertices, cage_.tets);
  int inside = 0;
  const Points points = testing::randomPoints(2000, 0.25, &random_);
  WeightRows weights;
  const std::vector<int> turns = cage.coordinates(points, &weights);
  for (Eigen::Index p = 0; p < points.rows(); ++p) {
    const bool expected = locator.locate(points.row(p)).barycentric.minCoeff() >= 0.0;
    inside += expected;
    EXPECT_EQ(turns[static_cast<std::size_t>(p)], expected ? 1 : 0);
  }
  EXPECT_GT(inside, 20);
}

/// Every tenth point of the doll-size problem, by the published formulas.
class DollSizeWeights : public ::testing::Test {
 protected:
  DollSizeWeights() : cage_(doll_.cage.vertices, doll_.cage.triangles) {
    for (Eigen::Index p = 0; 10 * p < doll_.points.rows(); ++p)
      doll_.points.row(p) = doll_.points.row(10 * p);
    doll_.points.conservativeResize(doll_.points.rows() / 10, Eigen::NoChange);
  }
  ~DollSizeWeights() override { useTargets(0); }

  /// Allowed SIMD targets; 0: all.
  static void useTargets(std::int64_t targets) {
    hwy::SetSupportedTargetsForTest(targets);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }

  bench::DollSize doll_ = bench::makeDollSize();
  MeanValueCage cage_;
};

TEST_F(DollSizeWeights, AreThoseOfTheReferenceWithEveryVectorWidth) {
  WeightRows exact, weights;
  bench::referenceMeanValueCoordinates<long double>(doll_.points, doll_.cage.vertices, doll_.cage.triangles,
                                                    &exact);
  const Eigen::VectorXd largest = exact.cwiseAbs().rowwise().maxCoeff();
  for (std::int64_t left = hwy::SupportedTargets() & HWY_TARGETS; left != 0; left &= left - 1) {
    const std::int64_t target = left & -left;
    useTargets(target);
    cage_.coordinates(doll_.points, &weights);
    const Eigen::VectorXd difference = (weights - exact).cwiseAbs().rowwise().maxCoeff();
    EXPECT_LT(difference.cwiseQuotient(largest).maxCoeff(), 1e-9) << hwy::TargetName(target);
    EXPECT_LT((weights * doll_.cage.vertices - doll_.points).cwiseAbs().maxCoeff(), 1e-12);
  }
}

TEST_F(DollSizeWeights, OfAFewPointsAreThoseOfMany) {
  WeightRows all, few;
  const std::vector<int> turns = cage_.coordinates(doll_.points, &all);
  for (const Eigen::Index count : {1, 3, 7, 9}) {
    EXPECT_EQ(cage_.coordinates(doll_.points.topRows(count), &few),
              std::vector<int>(turns.begin(), turns.begin() + count));
    // The polynomial of a point depends on its neighbours in the SIMD vector.
    EXPECT_LT((few - all.topRows(count)).cwiseAbs().maxCoeff(), 1e-13);
  }
  EXPECT_TRUE(cage_.coordinates(Points(0, 3), &few).empty());
}

TEST_F(MeanValueCoordinates, RefuseOpenCagesAndBadIndices) {
  Triangles open = cage_.surface.topRows(cage_.surface.rows() - 1);
  EXPECT_THROW(meanValueCoordinates(cage_.rest_vertices, cage_.rest_vertices, open), std::invalid_argument);
  Triangles flipped = cage_.surface;
  std::swap(flipped(0, 0), flipped(0, 1));
  EXPECT_THROW(meanValueCoordinates(cage_.rest_vertices, cage_.rest_vertices, flipped),
               std::invalid_argument);
  Triangles wild = cage_.surface;
  wild(3, 1) = 1000;
  EXPECT_THROW(meanValueCoordinates(cage_.rest_vertices, cage_.rest_vertices, wild), std::invalid_argument);
}

}  // namespace
}  // namespace softbody
