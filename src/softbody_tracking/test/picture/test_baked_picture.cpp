#include <gtest/gtest.h>

#include "fixtures/painted_box.h"
#include "picture/baked_picture.h"

namespace softbody {
namespace {

TriangleMesh meshOf(const PaintedBox& painted) {
  return {painted.box.surface.rest_vertices, painted.box.surface.triangles};
}

TEST(BakedPicture, HasTheColorOfThePlace) {
  const Paint paint = [](const Eigen::Vector3d& p) {
    return cv::Vec3b(cv::saturate_cast<uchar>(128 + 1000 * p.x()),
                     cv::saturate_cast<uchar>(128 + 2000 * p.y()),
                     cv::saturate_cast<uchar>(128 + 4000 * p.z()));
  };
  const PaintedBox painted(paint);
  const TriangleMesh mesh = meshOf(painted);
  const BakedPicture baked(painted.picture, mesh, painted.box.surface.texture_coordinates, 0.0014);
  for (int f = 0; f < mesh.triangles.rows(); ++f) {
    for (const auto& [w1, w2] : {std::pair(0.33, 0.33), std::pair(0.1, 0.8), std::pair(0.6, 0.2)}) {
      const Eigen::Vector3d rest = (1.0 - w1 - w2) * mesh.vertices.row(mesh.triangles(f, 0)) +
                                   w1 * mesh.vertices.row(mesh.triangles(f, 1)) +
                                   w2 * mesh.vertices.row(mesh.triangles(f, 2));
      const cv::Vec3f* color = baked.at(f, w1, w2);
      ASSERT_NE(color, nullptr);
      for (int k = 0; k < 3; ++k)
        EXPECT_NEAR((*color)[k], paint(rest)[k], 6.0) << f << " " << rest.transpose();
    }
  }
}

TEST(BakedPicture, HasNoColorWithoutCoordinates) {
  const PaintedBox painted(cells(1, 1.0));
  const TriangleMesh mesh = meshOf(painted);
  EXPECT_TRUE(BakedPicture(painted.picture, mesh, Points(), 0.002).empty());
  EXPECT_TRUE(BakedPicture(cv::Mat3b(), mesh, painted.box.surface.texture_coordinates, 0.002).empty());
  Points some = painted.box.surface.texture_coordinates;
  some.topRows(3).setZero();
  some(3, 0) = std::nan("");
  const BakedPicture baked(painted.picture, mesh, some, 0.002);
  EXPECT_EQ(baked.at(0, 0.3, 0.3), nullptr);
  EXPECT_EQ(baked.at(1, 0.3, 0.3), nullptr);
  EXPECT_NE(baked.at(2, 0.3, 0.3), nullptr);
}

}  // namespace
}  // namespace softbody
