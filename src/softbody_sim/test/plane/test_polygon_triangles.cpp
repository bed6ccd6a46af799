#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>
#include <set>

#include "plane/polygon_triangles.h"

namespace softbody {
namespace {

using Flat = std::vector<std::array<double, 2>>;

Points inPlane(const Flat& corners) {
  Points points = Points::Zero(static_cast<Eigen::Index>(corners.size()), 3);
  for (std::size_t k = 0; k < corners.size(); ++k)
    points.row(static_cast<Eigen::Index>(k)) << corners[k][0], corners[k][1], 0.0;
  return points;
}

Points startingAt(const Points& corners, Eigen::Index start) {
  Points turned(corners.rows(), 3);
  for (Eigen::Index k = 0; k < corners.rows(); ++k) turned.row(k) = corners.row((start + k) % corners.rows());
  return turned;
}

struct Areas {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double absolute = 0.0;
};

Areas areasOf(const std::vector<std::array<int, 3>>& triangles, const Points& corners) {
  Areas areas;
  for (const auto& [a, b, c] : triangles) {
    const Eigen::Vector3d ab = corners.row(b) - corners.row(a), ac = corners.row(c) - corners.row(a);
    areas.sum += 0.5 * ab.cross(ac);
    areas.absolute += 0.5 * ab.cross(ac).norm();
  }
  return areas;
}

/// Wherever it begins and however it lies: no overlap, the given area.
void expectArea(const Flat& flat, double area) {
  const Eigen::Matrix3d rotation =
      (Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized())).toRotationMatrix();
  const Points corners = (inPlane(flat) * rotation.transpose()).rowwise() + Eigen::RowVector3d(5, -3, 2);
  for (Eigen::Index start = 0; start < corners.rows(); ++start) {
    const Points turned = startingAt(corners, start);
    const PolygonTriangles result = polygonTriangles(turned);
    const Areas areas = areasOf(result.triangles, turned);
    EXPECT_TRUE(result.is_exact) << "from corner " << start;
    EXPECT_NEAR(areas.absolute, area, 1e-9) << "from corner " << start;
    EXPECT_NEAR(areas.sum.dot(rotation.col(2)), area, 1e-9) << "from corner " << start;
  }
}

TEST(PolygonTriangles, OfConcavePolygonsCoverThemOnce) {
  expectArea({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, 3.0);
  expectArea({{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}}, 7.0);
  expectArea({{0, 0}, {2, 0}, {0.5, 0.5}, {0, 2}}, 1.0);  // a concave quadrilateral
}

TEST(PolygonTriangles, KeepCollinearCornersAndJoinRepeatedOnes) {
  expectArea({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {0, 2}, {0, 1}}, 4.0);
  expectArea({{0, 0}, {0, 0}, {2, 0}, {2, 1}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, 3.0);
  const Points square = inPlane({{0, 0}, {1, 0}, {2, 0}, {2, 2}, {0, 2}});
  std::set<int> used;
  for (const auto& triangle : polygonTriangles(square).triangles)
    used.insert(triangle.begin(), triangle.end());
  EXPECT_EQ(used.size(), 5U);  // else a neighbour's edge stays open
}

TEST(PolygonTriangles, LeaveAHoleThatABridgeLeadsTo) {
  expectArea({{0, 0}, {3, 0}, {3, 3}, {0, 3}, {0, 0}, {1, 1}, {1, 2}, {2, 2}, {2, 1}, {1, 1}}, 8.0);
}

/// Corners around a centre at random distances are a simple polygon.
TEST(PolygonTriangles, OfRandomStarsCoverThemOnce) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> radius(0.1, 1.0);
  for (int trial = 0; trial < 50; ++trial) {
    const int count = 4 + trial;
    Flat star;
    for (int k = 0; k < count; ++k) {
      const double angle = 2.0 * M_PI * k / count, r = radius(random);
      star.push_back({r * std::cos(angle), r * std::sin(angle)});
    }
    double area = 0.0;
    for (int k = 0; k < count; ++k) {
      const auto &a = star[k], &b = star[(k + 1) % count];
      area += 0.5 * (a[0] * b[1] - a[1] * b[0]);
    }
    expectArea(star, area);
  }
}

/// The diagonal of a bent quadrilateral does not depend on its first corner.
TEST(PolygonTriangles, OfBentQuadsDoNotDependOnTheStart) {
  const Points bent = (Points(4, 3) << 0, 0, 0.1, 1, 0, 0, 1, 1, 0.1, 0, 1, 0).finished();
  const Eigen::Vector3d expected = areasOf(polygonTriangles(bent).triangles, bent).sum;
  const double area = areasOf(polygonTriangles(bent).triangles, bent).absolute;
  for (Eigen::Index start = 1; start < 4; ++start) {
    const Points turned = startingAt(bent, start);
    const Areas areas = areasOf(polygonTriangles(turned).triangles, turned);
    EXPECT_LT((areas.sum - expected).norm(), 1e-12);
    EXPECT_NEAR(areas.absolute, area, 1e-12);
  }
}

TEST(PolygonTriangles, SayThatAPolygonCrossesItself) {
  EXPECT_FALSE(polygonTriangles(inPlane({{0, 0}, {2, 2}, {2, 0}, {0, 3}})).is_exact);
  EXPECT_FALSE(polygonTriangles(inPlane({{0, 0}, {1, 0}, {2, 0}, {3, 0}})).is_exact);
}

}  // namespace
}  // namespace softbody
