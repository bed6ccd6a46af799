#include "softbody_scanning/surface/remeshing.h"

#include <gtest/gtest.h>

namespace softbody::scanning {
namespace {

TEST(Remeshing, takesTrianglesOnALine) {
  TriangleMesh needle{Points(4, 3), Triangles(4, 3)};
  needle.vertices << 0, 0, 0, 2e-3, 0, 0, 4e-3, 0, 0, 6e-3, 0, 0;
  needle.triangles << 0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3;
  const TriangleMesh mesh = remeshed(needle, 2e-3);
  EXPECT_TRUE(mesh.vertices.allFinite());
}

}  // namespace
}  // namespace softbody::scanning
