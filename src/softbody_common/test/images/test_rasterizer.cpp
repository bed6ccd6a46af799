#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <stdexcept>

#include "random_meshes.h"
#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_common/images/rasterizer.h"

namespace softbody {
namespace {

const Pinhole kCamera{64, 48, 50.0, 52.0, 31.3, 24.2};

struct Hit {
  int triangle = -1;
  double z = 0.0, margin = 0.0;  ///< smallest weight: how far inside its triangle
};

/// The nearest triangle along a pixel's ray, by solving for the crossing point.
Hit castRay(double u, double v, const Points& vertices, const Triangles& triangles) {
  Hit best;
  const Eigen::Vector3d ray = kCamera.unproject(u, v, 1.0);
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k) corners.col(k) = vertices.row(triangles(f, k)).transpose();
    // z * ray = corners * w with w summing to 1.
    const Eigen::Vector3d w = corners.inverse() * ray;
    const double z = 1.0 / w.sum();
    if (!(z > 0.0) || w.minCoeff() * z < 0.0) continue;
    if (best.triangle < 0 || z < best.z) best = {static_cast<int>(f), z, w.minCoeff() * z};
  }
  return best;
}

/// Unconnected triangles in front of the camera, some reaching over the image's border.
TriangleMesh triangleSoup(int count, std::mt19937* random) {
  TriangleMesh mesh;
  mesh.vertices.resize(3 * count, 3);
  mesh.triangles.resize(count, 3);
  for (int f = 0; f < count; ++f) {
    const Eigen::Vector3d center = randomPoint(-0.5, 0.5, random) + Eigen::Vector3d(0.0, 0.0, 1.0);
    for (int k = 0; k < 3; ++k) {
      mesh.vertices.row(3 * f + k) =
          (center + randomPoint(-0.3, 0.3, random)).cwiseMax(Eigen::Vector3d(-9, -9, 0.05));
      mesh.triangles(f, k) = 3 * f + k;
    }
  }
  return mesh;
}

/// Two triangles a cell. @param corner gives the vertex of a column and a row.
template <typename Corner>
TriangleMesh gridMesh(int columns, int rows, Corner corner) {
  TriangleMesh mesh;
  mesh.vertices.resize((columns + 1) * (rows + 1), 3);
  mesh.triangles.resize(2 * columns * rows, 3);
  for (int r = 0, f = 0; r <= rows; ++r) {
    for (int c = 0; c <= columns; ++c) {
      const int i = r * (columns + 1) + c;
      mesh.vertices.row(i) = corner(c, r);
      if (r == rows || c == columns) continue;
      mesh.triangles.row(f++) << i, i + 1, i + columns + 1;
      mesh.triangles.row(f++) << i + 1, i + columns + 2, i + columns + 1;
    }
  }
  return mesh;
}

class Rasterizer : public testing::TestWithParam<unsigned> {
 protected:
  std::mt19937 random_{GetParam()};
};
INSTANTIATE_TEST_SUITE_P(Seeds, Rasterizer, testing::Range(0u, 10u));

TEST_P(Rasterizer, AgreesWithRayCasting) {
  const TriangleMesh mesh = triangleSoup(30, &random_);
  RasterImage image;
  rasterize(kCamera, mesh.vertices, mesh.triangles, &image);
  for (int v = 0; v < kCamera.height; ++v) {
    for (int u = 0; u < kCamera.width; ++u) {
      const Hit hit = castRay(u, v, mesh.vertices, mesh.triangles);
      if (hit.triangle >= 0 && hit.margin < 1e-6) continue;  // on an edge either answer is right
      EXPECT_EQ(image.triangle(v, u), hit.triangle) << u << " " << v;
      EXPECT_NEAR(image.depth(v, u), hit.z, 1e-6 * hit.z);
    }
  }
}

TEST_P(Rasterizer, WeightsReproduceThePointBehindThePixel) {
  const TriangleMesh mesh = triangleSoup(30, &random_);
  RasterImage image;
  rasterize(kCamera, mesh.vertices, mesh.triangles, &image);
  int covered = 0;
  for (int v = 0; v < kCamera.height; ++v) {
    for (int u = 0; u < kCamera.width; ++u) {
      const int f = image.triangle(v, u);
      EXPECT_EQ(f < 0, image.depth(v, u) == 0.0f);
      EXPECT_EQ(f >= 0 && !image.region.contains(cv::Point(u, v)), false);
      if (f < 0) continue;
      ++covered;
      const Eigen::Vector3d weights = rayWeights(kCamera, mesh.vertices, mesh.triangles, f, u, v);
      EXPECT_GT(weights.minCoeff(), -1e-6);
      Eigen::Vector3d point = Eigen::Vector3d::Zero();
      for (int k = 0; k < 3; ++k) point += weights[k] * mesh.vertices.row(mesh.triangles(f, k)).transpose();
      EXPECT_LT((point - kCamera.unproject(u, v, image.depth(v, u))).norm(), 1e-6);
    }
  }
  EXPECT_GT(covered, 100);
}

TEST_P(Rasterizer, PlanesAreExactAndWithoutHoles) {
  // A grid of triangles whose edges run through pixel centres.
  const Eigen::Vector3d normal =
      (Eigen::Vector3d(0, 0, -1) + 0.4 * randomPoint(-1, 1, &random_)).normalized();
  const auto depth_at = [&](double u, double v) { return -0.5 / normal.dot(kCamera.unproject(u, v, 1.0)); };
  const TriangleMesh mesh = gridMesh(16, 12, [&](int c, int r) -> Eigen::Vector3d {
    return kCamera.unproject(4 * c, 4 * r, depth_at(4 * c, 4 * r));
  });
  RasterImage image;
  rasterize(kCamera, mesh.vertices, mesh.triangles, &image);
  for (int v = 0; v < kCamera.height; ++v) {
    for (int u = 0; u < kCamera.width; ++u)
      EXPECT_NEAR(image.depth(v, u), depth_at(u, v), 1e-6) << u << " " << v;
  }
}

TEST_P(Rasterizer, TrianglesSmallerThanAPixelAgreeWithTheSurfaceThatTheyDivide) {
  // A plane in triangles of about a pixel, as of a fine mesh, slivers among them.
  const Eigen::Vector3d normal =
      (Eigen::Vector3d(0, 0, -1) + 0.4 * randomPoint(-1, 1, &random_)).normalized();
  const auto depth_at = [&](double u, double v) { return -0.5 / normal.dot(kCamera.unproject(u, v, 1.0)); };
  std::uniform_real_distribution<double> shake(-0.3, 0.3);
  const TriangleMesh mesh = gridMesh(60, 44, [&](int c, int r) -> Eigen::Vector3d {
    const double u = 3.0 + 0.9 * c + shake(random_), v = 3.0 + 0.9 * r + shake(random_);
    return kCamera.unproject(u, v, depth_at(u, v));
  });
  RasterImage image;
  rasterize(kCamera, mesh.vertices, mesh.triangles, &image);
  for (int v = 4; v < 42; ++v) {
    for (int u = 4; u < 56; ++u) {
      ASSERT_GE(image.triangle(v, u), 0) << "a hole at " << u << " " << v;
      EXPECT_NEAR(image.depth(v, u), depth_at(u, v), 2e-6) << u << " " << v;
      const Eigen::Vector3d weights =
          rayWeights(kCamera, mesh.vertices, mesh.triangles, image.triangle(v, u), u, v);
      EXPECT_GT(weights.minCoeff(), -1e-4);
    }
  }
}

TEST_P(Rasterizer, AReusedImageEqualsAFreshOne) {
  RasterImage used, fresh;
  const TriangleMesh before = triangleSoup(20, &random_), after = triangleSoup(3, &random_);
  rasterize(kCamera, before.vertices, before.triangles, &used);
  rasterize(kCamera, after.vertices, after.triangles, &used);
  rasterize(kCamera, after.vertices, after.triangles, &fresh);
  EXPECT_EQ(cv::norm(used.depth, fresh.depth, cv::NORM_INF), 0.0);
  EXPECT_EQ(cv::norm(used.triangle, fresh.triangle, cv::NORM_INF), 0.0);
  EXPECT_EQ(used.region, fresh.region);
}

TEST_P(Rasterizer, AClosedMeshLooksTheSameWithoutTheFacesThatLookAway) {
  const TetMesh block = shakenBlock(4, 3, 2, 0.1, 0.15, &random_);
  const Triangles triangles = boundaryTriangles(block.tets);
  const Eigen::Matrix3d turn = randomMotion(&random_).linear();
  const Points turned = block.vertices * turn.transpose();
  const Points vertices = turned.rowwise() + (Eigen::RowVector3d(0, 0, 1) - turned.colwise().mean());
  ASSERT_TRUE(isClosed(triangles));
  EXPECT_FALSE(isClosed(triangles.topRows(triangles.rows() - 1)));
  RasterImage all, front;
  rasterize(kCamera, vertices, triangles, &all);
  rasterize(kCamera, vertices, triangles, &front, Faces::kFront);
  EXPECT_GT(cv::countNonZero(all.depth), 30);
  EXPECT_LE(cv::norm(all.depth, front.depth, cv::NORM_INF), 0.0);
  EXPECT_EQ(all.region, front.region);
}

TEST(RasterizerEdges, NothingUnusableIsDrawn) {
  Points vertices(3, 3);
  vertices << -1, -1, 0.5, 1, -1, 0.5, 0, 1, -0.5;  // through the camera plane
  Triangles triangle(1, 3);
  triangle << 0, 1, 2;
  RasterImage image;
  rasterize(kCamera, vertices, triangle, &image);
  EXPECT_EQ(cv::countNonZero(image.depth), 0);
  vertices(2, 2) = NAN;
  rasterize(kCamera, vertices, triangle, &image);
  EXPECT_EQ(cv::countNonZero(image.depth), 0);
  vertices(2, 2) = 1e300;
  vertices(2, 0) = -1e308;
  rasterize(kCamera, vertices, triangle, &image);
  rasterize(kCamera, Points(0, 3), Triangles(0, 3), &image);
  EXPECT_EQ(cv::countNonZero(image.triangle != -1), 0);
  EXPECT_TRUE(image.region.empty());
}

TEST(RasterizerEdges, IndicesOutOfRangeAreRefused) {
  Triangles triangle(1, 3);
  RasterImage image;
  triangle << 0, 1, 3;
  EXPECT_THROW(rasterize(kCamera, Points::Ones(3, 3), triangle, &image), std::invalid_argument);
  triangle << 0, 1, -1;
  EXPECT_THROW(rasterize(kCamera, Points::Ones(3, 3), triangle, &image), std::invalid_argument);
}

}  // namespace
}  // namespace softbody
