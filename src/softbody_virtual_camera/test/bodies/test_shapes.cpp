#include "softbody_virtual_camera/bodies/shapes.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "softbody_common/geometry/tet_geometry.h"

namespace softbody::virtual_camera {
namespace {

TEST(Capsule, IsClosedOutwardAndAsLargeAsItShouldBe) {
  const double radius = 0.01, length = 0.05, pi = 3.14159265358979;
  const Eigen::Vector3d a(0.1, -0.2, 0.3), b = a + length * Eigen::Vector3d(0.3, -0.5, 0.8).normalized();
  const TriangleMesh mesh = capsule(a, b, radius);
  const double volume = pi * radius * radius * (length + 4.0 / 3.0 * radius);
  EXPECT_NEAR(enclosedVolume(mesh.vertices, mesh.triangles), volume, 0.03 * volume);
  EXPECT_EQ(mesh.vertices.rows() - mesh.triangles.rows() / 2, 2);  // Euler number of a closed sphere
}

TEST(Merge, KeepsOrderAndVolume) {
  const TriangleMesh part = capsule({0, 0, 0}, {0.1, 0, 0}, 0.02);
  const TriangleMesh both = merge({part, part});
  EXPECT_EQ(both.vertices.bottomRows(part.vertices.rows()), part.vertices);
  EXPECT_NEAR(enclosedVolume(both.vertices, both.triangles),
              2.0 * enclosedVolume(part.vertices, part.triangles), 1e-12);
}

}  // namespace
}  // namespace softbody::virtual_camera
