#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_evaluation/measures/cut_surface.h"
#include "softbody_evaluation/measures/vertex_match.h"
#include "softbody_evaluation/measures/volume.h"

namespace softbody::evaluation {
namespace {

/// Both sides of a square cut of 60 mm in the plane z = 0, n by n squares each, moved by T. Without the rest
/// of the body, which does not matter to the surface of the cut.
MeshTopology squareCut(int n, const Eigen::Isometry3d& T = Eigen::Isometry3d::Identity()) {
  constexpr double kSide = 0.06;
  const int count = (n + 1) * (n + 1);
  MeshTopology mesh;
  mesh.rest_vertices.resize(2 * count, 3);
  for (int i = 0; i < 2 * count; ++i) {
    const int k = i % count;
    const Eigen::Vector3d place(kSide * (k % (n + 1)) / n - 0.5 * kSide,
                                kSide * (k / (n + 1)) / n - 0.5 * kSide, 0.0);
    mesh.rest_vertices.row(i) = T * place;
  }
  mesh.triangles.resize(4 * n * n, 3);
  for (int i = 0, f = 0; i < n * n; ++i) {
    const int a = i / n * (n + 1) + i % n, b = a + 1, c = a + n + 1, d = c + 1;
    mesh.triangles.row(f++) << a, b, d;
    mesh.triangles.row(f++) << a, d, c;
    mesh.triangles.row(f++) << count + d, count + b, count + a;
    mesh.triangles.row(f++) << count + c, count + d, count + a;
  }
  mesh.vertex_parents.assign(static_cast<std::size_t>(2 * count), -1);
  for (int f = 0; f < 4 * n * n; ++f) mesh.triangle_pieces.push_back(f % 4 < 2 ? 0 : 1);
  mesh.cut.assign(static_cast<std::size_t>(4 * n * n), true);
  return mesh;
}

TEST(CutSurface, TheSameSurfaceTriangulatedOtherwiseHasNoError) {
  const CutSurfaceReport report = compareCutSurfaces(squareCut(7), squareCut(3));
  EXPECT_LT(report.distance.max, 1e-9);
  EXPECT_LT(report.missed.max, 1e-9);
  EXPECT_LT(report.angle.max, 1e-6);
  EXPECT_LT(report.tilt_rad, 1e-9);
  EXPECT_NEAR(report.area_ratio, 1.0, 1e-12);
}

TEST(CutSurface, AShiftIsTheDistance) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation().z() = 0.0015;
  const CutSurfaceReport report = compareCutSurfaces(squareCut(4, T), squareCut(5));
  EXPECT_NEAR(report.distance.mean, 0.0015, 1e-8);
  EXPECT_NEAR(report.distance.max, 0.0015, 1e-8);
  EXPECT_LT(report.tilt_rad, 1e-9);
}

TEST(CutSurface, ARotationIsTheAngleWhateverTheCutsPoseInTheBody) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int trial = 0; trial < 20; ++trial) {
    Eigen::Isometry3d place(Eigen::Quaterniond::UnitRandom());
    place.translation() << unit(random), unit(random), unit(random);
    const double angle = 0.02 + 0.03 * trial / 20.0;
    const Eigen::Isometry3d turned = place * Eigen::AngleAxisd(angle, Eigen::Vector3d(1, 2, 0).normalized());
    const CutSurfaceReport report = compareCutSurfaces(squareCut(4, turned), squareCut(3, place));
    EXPECT_NEAR(report.tilt_rad, angle, 1e-6);
    EXPECT_NEAR(report.angle.mean, angle, 1e-6);
  }
}

TEST(CutSurface, RoughnessIsLocalAndNoTilt) {
  MeshTopology rough = squareCut(20);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> height(-2e-4, 2e-4);
  for (Eigen::Index i = 0; i < rough.rest_vertices.rows() / 2; ++i) {
    rough.rest_vertices(i, 2) = rough.rest_vertices(i + rough.rest_vertices.rows() / 2, 2) = height(random);
  }
  const CutSurfaceReport report = compareCutSurfaces(rough, squareCut(2));
  EXPECT_GT(report.angle.mean, 0.03);
  EXPECT_LT(report.tilt_rad, 0.005);
  EXPECT_LT(report.distance.max, 2e-4 + 1e-9);
}

TEST(CutSurface, HalfACutIsMissedByHalf) {
  MeshTopology half = squareCut(6);
  for (Eigen::Index f = 0; f < half.triangles.rows(); ++f) {
    const double x = half.rest_vertices(half.triangles(f, 0), 0) +
                     half.rest_vertices(half.triangles(f, 1), 0) +
                     half.rest_vertices(half.triangles(f, 2), 0);
    half.cut[static_cast<std::size_t>(f)] = x < 0.0;
  }
  const CutSurfaceReport report = compareCutSurfaces(half, squareCut(6));
  EXPECT_LT(report.distance.max, 1e-9);
  EXPECT_NEAR(report.area_ratio, 0.5, 1e-9);
  EXPECT_NEAR(report.missed.max, 0.03, 0.001);
  EXPECT_EQ(compareCutSurfaces(MeshTopology(), squareCut(2)).distance.count, 0u);
}

TEST(VertexMatch, InsideOfACutsSurfaceSidesAreToldApartByWhereTheyFace) {
  const MeshTopology mesh = squareCut(4);
  const std::vector<int> matches = matchVertices(mesh, mesh, 0.002);
  for (std::size_t i = 0; i < matches.size(); ++i) EXPECT_EQ(matches[i], static_cast<int>(i));
}

/// Two boxes, once as one piece with a common face that is not there, once apart with that face filled.
TEST(Volume, IsFollowedAcrossACut) {
  const auto box = [](double x) {
    TriangleMesh mesh{Points(8, 3), Triangles(12, 3)};
    for (int i = 0; i < 8; ++i)
      mesh.vertices.row(i) << x + 0.1 * (i & 1), 0.1 * (i >> 1 & 1), 0.1 * (i >> 2 & 1);
    mesh.triangles << 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6,
        2, 1, 3, 7, 1, 7, 5;
    return mesh;
  };
  std::map<std::uint32_t, MeshTopology> topologies;
  const TriangleMesh whole = box(0.0), left = box(0.0), right = box(0.2);
  topologies[0].rest_vertices = whole.vertices;
  topologies[0].rest_vertices.col(0) *= 2.0;
  topologies[0].triangles = whole.triangles;
  topologies[1].revision = 1;
  topologies[1].rest_vertices.resize(16, 3);
  topologies[1].rest_vertices << left.vertices, right.vertices;
  topologies[1].rest_vertices.col(0) *= 0.999;  // the cut loses a thousandth
  topologies[1].triangles.resize(24, 3);
  topologies[1].triangles << left.triangles, right.triangles.array() + 8;
  MeshState before, after;
  before.vertices = topologies[0].rest_vertices;
  after.revision = 1;
  after.vertices = 1.01 * topologies[1].rest_vertices;
  const VolumeReport report = volumeDrift(topologies, {&before, &after});
  ASSERT_TRUE(report.closed);
  EXPECT_NEAR(report.rest_m3, 2e-3, 1e-12);
  EXPECT_NEAR(report.cut_change, -0.001, 1e-9);
  EXPECT_NEAR(report.change.largest, 0.999 * 1.030301 - 1.0, 1e-9);
  topologies[1].triangles.conservativeResize(23, 3);
  EXPECT_FALSE(volumeDrift(topologies, {&before, &after}).closed);
}

}  // namespace
}  // namespace softbody::evaluation
