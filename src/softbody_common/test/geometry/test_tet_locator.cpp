#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "random_meshes.h"
#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_common/geometry/tet_locator.h"

namespace softbody {
namespace {

/// Distance to a tet as the meet of four half-spaces, by Dykstra's alternating projections.
double distanceByDykstra(const Eigen::Vector3d& p, const TetMesh& mesh, int t) {
  Eigen::Matrix<double, 4, 3> corners;
  for (int k = 0; k < 4; ++k) corners.row(k) = mesh.vertices.row(mesh.tets(t, k));
  static constexpr int kFaces[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  Eigen::Vector3d x = p;
  Eigen::Matrix<double, 4, 3> corrections = Eigen::Matrix<double, 4, 3>::Zero();
  for (int iteration = 0; iteration < 3000; ++iteration) {
    for (int f = 0; f < 4; ++f) {
      const Eigen::Vector3d a = corners.row(kFaces[f][0]), b = corners.row(kFaces[f][1]),
                            c = corners.row(kFaces[f][2]);
      const Eigen::Vector3d normal = (b - a).cross(c - a).normalized();
      const Eigen::Vector3d y = x + corrections.row(f).transpose();
      x = y - std::max(0.0, normal.dot(y - a)) * normal;
      corrections.row(f) = (y - x).transpose();
    }
  }
  return (x - p).norm();
}

class Locator : public testing::TestWithParam<unsigned> {
 protected:
  std::mt19937 random_{GetParam()};
  TetMesh mesh_ = shakenBlock(4, 3, 2, 0.02, 0.15, &random_);
  TetLocator locator_{mesh_.vertices, mesh_.tets};
};
INSTANTIATE_TEST_SUITE_P(Seeds, Locator, testing::Range(0u, 5u));

TEST_P(Locator, PointsMadeInsideATetAreFoundThere) {
  std::exponential_distribution<double> weight;
  for (int trial = 0; trial < 500; ++trial) {
    Eigen::Vector4d barycentric;
    for (int k = 0; k < 4; ++k) barycentric[k] = weight(random_) + 1e-3;
    barycentric /= barycentric.sum();
    const int t = static_cast<int>(random_() % mesh_.tets.rows());
    const MaterialPoint place = locator_.locate(positionOf({t, barycentric}, mesh_.vertices, mesh_.tets));
    EXPECT_EQ(place.tet, t);
    EXPECT_LT((place.barycentric - barycentric).norm(), 1e-9);
  }
}

TEST_P(Locator, EveryPointIsReproduced) {
  for (int trial = 0; trial < 500; ++trial) {
    const Eigen::Vector3d point = randomPoint(-0.1, 0.2, &random_);
    const MaterialPoint place = locator_.locate(point);
    EXPECT_NEAR(place.barycentric.sum(), 1.0, 1e-9);
    EXPECT_LT((positionOf(place, mesh_.vertices, mesh_.tets) - point).norm(), 1e-10);
  }
}

TEST_P(Locator, ContainsWhatItLocatesWithinATet) {
  int inside = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const Eigen::Vector3d point = randomPoint(-0.1, 0.2, &random_);
    const bool located = locator_.locate(point).barycentric.minCoeff() >= 0.0;
    inside += located ? 1 : 0;
    EXPECT_EQ(locator_.contains(point), located);
  }
  EXPECT_GT(inside, 0);
}

TEST_P(Locator, OutsidePointsGoToTheNearestTet) {
  // A few tets far apart: the nearest one is often several cells away.
  TetMesh sparse = mesh_;
  sparse.tets.resize(6, 4);
  for (Eigen::Index t = 0; t < 6; ++t) sparse.tets.row(t) = mesh_.tets.row(random_() % mesh_.tets.rows());
  const TetLocator locator(sparse.vertices, sparse.tets);
  for (int trial = 0; trial < 60; ++trial) {
    const Eigen::Vector3d point = randomPoint(-0.03, 0.11, &random_);
    double nearest = std::numeric_limits<double>::infinity();
    for (int t = 0; t < sparse.tets.rows(); ++t)
      nearest = std::min(nearest, distanceByDykstra(point, sparse, t));
    EXPECT_NEAR(distanceByDykstra(point, sparse, locator.locate(point).tet), nearest, 1e-6);
  }
}

TEST_P(Locator, TiesGoToTheLowestIndex) {
  for (Eigen::Index v = 0; v < mesh_.vertices.rows(); ++v) {
    const int found = locator_.locate(mesh_.vertices.row(v)).tet;
    // Rounding may put a vertex just outside of some of its tets; the one found must be one of its own.
    EXPECT_TRUE((mesh_.tets.row(found).array() == static_cast<int>(v)).any());
  }
  const TetMesh block = blockOfTets(2, 2, 2, 1.0);  // exact arithmetic
  const TetLocator exact(block.vertices, block.tets);
  for (Eigen::Index v = 0; v < block.vertices.rows(); ++v) {
    Eigen::Index lowest = 0;
    while (!(block.tets.row(lowest).array() == static_cast<int>(v)).any()) ++lowest;
    EXPECT_EQ(exact.locate(block.vertices.row(v)).tet, static_cast<int>(lowest));
  }
}

TEST_P(Locator, BindingsFollowAnyAffineMotion) {
  Points points(50, 3);
  for (Eigen::Index i = 0; i < 50; ++i) points.row(i) = randomPoint(-0.02, 0.1, &random_);
  const std::vector<MaterialPoint> places = bindPoints(points, mesh_.vertices, mesh_.tets);
  const Eigen::Matrix3d A = Eigen::Matrix3d::Random();
  const Points moved = applyBinding(places, mesh_.vertices * A, mesh_.tets);
  EXPECT_LT((moved - points * A).cwiseAbs().maxCoeff(), 1e-9);
}

TEST_P(Locator, FarPointsAreLocatedToo) {
  for (const double distance : {10.0, 1e6, 1e10}) {
    const MaterialPoint place = locator_.locate(Eigen::Vector3d(distance, 0.03, 0.02));
    // The nearest tet lies on the side of high x.
    double highest = -1.0;
    for (int k = 0; k < 4; ++k) highest = std::max(highest, mesh_.vertices(mesh_.tets(place.tet, k), 0));
    EXPECT_GT(highest, 0.07);
  }
}

TEST(LocatorErrors, AreSentences) {
  EXPECT_THROW(TetLocator(Points(0, 3), Tets(0, 4)), std::invalid_argument);
  TetMesh mesh = blockOfTets(1, 1, 1, 1.0);
  EXPECT_THROW(TetLocator(mesh.vertices, mesh.tets).locate({NAN, 0.0, 0.0}), std::invalid_argument);
  mesh.tets(3, 1) = mesh.tets(3, 0);
  EXPECT_THROW(TetLocator(mesh.vertices, mesh.tets), std::invalid_argument);
  mesh.tets(3, 1) = 99;
  EXPECT_THROW(TetLocator(mesh.vertices, mesh.tets), std::invalid_argument);
}

}  // namespace
}  // namespace softbody
