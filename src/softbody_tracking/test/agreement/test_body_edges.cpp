#include "agreement/body_edges.h"

#include <gtest/gtest.h>

#include "registration/box_mesh.h"
#include "softbody_common/geometry/rigid_fit.h"

namespace softbody {
namespace {

constexpr double kTable = 0.6;  // [m]

/// The box flat on a table, seen from above; its upper side is 0.04 m nearer.
Eigen::Isometry3d onTable(double x = 0.0) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, 0.0, kTable - 0.02));
}

RgbdFrame boxOnTable() {
  RgbdFrame frame = renderFrame(kBox, transformed(kMesh.vertices, onTable()), 1);
  frame.depth.setTo(kTable, frame.depth > 1.0f);
  return frame;
}

TEST(ShareWithoutEdge, IsSmallAtTheBody) {
  EXPECT_LT(shareWithoutEdge(boxOnTable(), kMesh, onTable()), 0.05);
}

/// Only the depth inside the silhouette agrees: the upper side lies in the table.
TEST(ShareWithoutEdge, IsLargeInsideATable) {
  const Eigen::Isometry3d sunk(Eigen::Translation3d(0.0, 0.25, kTable + 0.02));
  EXPECT_GT(shareWithoutEdge(boxOnTable(), kMesh, sunk), 0.9);
}

TEST(ShareWithoutEdge, SeesThatTheBodyIsLarger) {
  const TriangleMesh smaller{0.7 * kMesh.vertices, kMesh.triangles};
  const Eigen::Isometry3d pose(Eigen::Translation3d(0.0, 0.0, kTable - 0.04 + 0.7 * 0.02));
  EXPECT_GT(shareWithoutEdge(boxOnTable(), smaller, pose), kLargestShareWithoutEdge);
}

/// A bent body's outline is some millimetres beside that of the mesh.
TEST(ShareWithoutEdge, IsSmallThoughTheOutlineIsALittleInside) {
  const Points shrunk = kMesh.vertices * Eigen::Vector3d(0.97, 0.97, 1.0).asDiagonal();
  EXPECT_LT(shareWithoutEdge(boxOnTable(), {shrunk, kMesh.triangles}, onTable()), 0.05);
}

/// A body that is thinner than the distance scale still has edges.
TEST(ShareWithoutEdge, WorksForAThinBody) {
  Points thin = kMesh.vertices;
  thin.col(2) *= 0.1;
  const TriangleMesh mesh{thin, kMesh.triangles};
  BoxBody body = kBox;
  body.surface.rest_vertices = thin;
  const Eigen::Isometry3d pose(Eigen::Translation3d(0.0, 0.0, kTable - 0.002));
  RgbdFrame frame = renderFrame(body, transformed(thin, pose), 1);
  frame.depth.setTo(kTable, frame.depth > 1.0f);
  EXPECT_LT(shareWithoutEdge(frame, mesh, pose), 0.05);
}

}  // namespace
}  // namespace softbody
