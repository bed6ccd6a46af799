#include <gtest/gtest.h>

#include <map>

#include "cutting/fixtures/visual_sponge.h"
#include "softbody_sim/cutting/binding/cuttable_body.h"
#include "softbody_sim/cutting/patch/cut_shapes.h"
#include "softbody_sim/surface_mesh/cut_lines.h"

namespace softbody {
namespace {

using testing::visualSponge;

double lengthOf(const Edges& lines, const Points& vertices) {
  double length = 0.0;
  for (const auto& edge : lines.rowwise()) length += (vertices.row(edge[0]) - vertices.row(edge[1])).norm();
  return length;
}

/// Lines are closed: every vertex has an even number of edges.
void expectClosed(const Edges& lines) {
  std::map<int, int> ends;
  for (const int vertex : lines.reshaped()) ++ends[vertex];
  for (const auto& [vertex, count] : ends) EXPECT_EQ(count % 2, 0) << vertex;
}

MeshTopology cutBy(const TriangleMesh& patch) {
  const CuttableBody surface(visualSponge(), testing::sponge());
  const CutPreview preview = surface.preview(patch);
  EXPECT_EQ(preview.refusal, "");
  return preview.pieces;
}

TEST(CutLines, AreNotOnAnUncutBody) { EXPECT_EQ(cutLines(visualSponge()).rows(), 0); }

TEST(CutLines, AreTheEdgesOfACutFaceWhereItMeetsTheSkin) {
  MeshTopology mesh;  // a tet whose first face is cut
  mesh.rest_vertices = Points::Random(4, 3);
  mesh.triangles.resize(4, 3);
  mesh.triangles << 2, 1, 0, 0, 1, 3, 1, 2, 3, 2, 0, 3;
  mesh.cut = {true, false, false, false};
  Edges expected(3, 2);
  expected << 0, 1, 0, 2, 1, 2;
  EXPECT_EQ(cutLines(mesh), expected);
}

TEST(CutLines, RunRoundEveryPieceOfASeparatedBody) {
  const MeshTopology uncut = visualSponge();
  const Eigen::Vector3d point(0.083, 0.05, 0.015);
  const MeshTopology pieces = cutBy(planePatch(point, Eigen::Vector3d::UnitX(), uncut.rest_vertices));
  const Edges lines = cutLines(pieces);
  expectClosed(lines);
  const Eigen::RowVector3d size =
      uncut.rest_vertices.colwise().maxCoeff() - uncut.rest_vertices.colwise().minCoeff();
  EXPECT_NEAR(lengthOf(lines, pieces.rest_vertices), 2.0 * 2.0 * (size.y() + size.z()), 1e-6);
  for (const int vertex : lines.reshaped()) EXPECT_NEAR(pieces.rest_vertices(vertex, 0), point.x(), 1e-6);
}

TEST(CutLines, RunAlongBothSidesOfASlit) {
  Points corners(4, 3);  // through the top, to the middle of the height
  corners << 0.083, -0.01, 0.015, 0.083, 0.11, 0.015, 0.083, 0.11, 0.04, 0.083, -0.01, 0.04;
  const MeshTopology slit = cutBy(polygonPatch(corners));
  const Edges lines = cutLines(slit);
  expectClosed(lines);
  const double top = visualSponge().rest_vertices.col(2).maxCoeff(), width = 0.096;
  // Both rims on the top and down the sides. They meet at the front, where the slit ends.
  EXPECT_NEAR(lengthOf(lines, slit.rest_vertices), 2.0 * (width + 2.0 * (top - 0.015)), 1e-6);
  for (const int vertex : lines.reshaped()) EXPECT_GE(slit.rest_vertices(vertex, 2), 0.015 - 1e-6);
}

}  // namespace
}  // namespace softbody
