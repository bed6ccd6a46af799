#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include <test_support/scratch_folder.h>
#include "softbody_common/images/vertex_colors.h"

namespace softbody {
namespace {

namespace fs = std::filesystem;

const VertexColors kThree{{255, 0, 51}, {0, 102, 255}, {10, 20, 30}};

class Colors : public ::testing::Test {
 protected:
  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }

  /// A PLY of one triangle. @param type of the colours. @param rows their text or bytes with the positions.
  fs::path ply(const std::string& format, const std::string& type, const std::string& rows) const {
    std::string header = "ply\nformat " + format + " 1.0\nelement vertex 3\n";
    for (const char* axis : {"x", "y", "z"}) header += std::string("property float ") + axis + "\n";
    for (const char* color : {"red", "green", "blue"}) header += "property " + type + " " + color + "\n";
    return write("mesh.ply",
                 header + "element face 1\nproperty list uchar int vertex_indices\nend_header\n" + rows);
  }

  test::ScratchFolder folder_;
};

TEST_F(Colors, ofAPlyAreBytesOrShares) {
  EXPECT_EQ(
      readVertexColors(ply("ascii", "uchar", "0 0 0 255 0 51\n1 0 0 0 102 255\n0 1 0 10 20 30\n3 0 1 2\n")),
      kThree);
  EXPECT_EQ(readVertexColors(
                ply("ascii", "float", "0 0 0 1 0 0.2\n1 0 0 0 0.4 1\n0 1 0 .0392 .0784 .1176\n3 0 1 2\n")),
            kThree);
}

TEST_F(Colors, ofABinaryPly) {
  std::string rows;
  for (const auto& color : kThree) rows += std::string(12, '\0') + std::string(color.begin(), color.end());
  rows += std::string("\3\0\0\0\0\1\0\0\0\2\0\0\0", 13);
  EXPECT_EQ(readVertexColors(ply("binary_little_endian", "uchar", rows)), kThree);
}

TEST_F(Colors, ofAPlyMayStandAfterAnotherElement) {
  EXPECT_EQ(readVertexColors(write("mesh.ply",
                                   "ply\nformat ascii 1.0\nelement camera 1\nproperty float fov\n"
                                   "element vertex 1\nproperty uchar red\nproperty uchar green\n"
                                   "property uchar blue\nend_header\n0.5\n255 0 51\n")),
            VertexColors({kThree[0]}));
}

TEST_F(Colors, ofAnObjStandAfterThePosition) {
  EXPECT_EQ(readVertexColors(write(
                "mesh.obj", "# v 9\nv 0 0 0 1 0 0.2\nv 1 0 0 0 .4 1\nv 0 1 0 .0392 .0784 .1176\nf 1 2 3\n")),
            kThree);
}

TEST_F(Colors, areNoneIfAVertexHasNone) {
  EXPECT_TRUE(readVertexColors(write("mesh.obj", "v 0 0 0 1 0 0.2\nv 1 0 0\n")).empty());
  EXPECT_TRUE(
      readVertexColors(
          write("plain.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n"))
          .empty());
  EXPECT_TRUE(readVertexColors(write("mesh.stl", "solid")).empty());
}

TEST_F(Colors, ofAnObjectAreThoseOfItsVisualMesh) {
  write("mesh.obj", "v 0 0 0 1 0 0.2\n");
  const fs::path yaml = write("object.yaml", "object: {visual_mesh: mesh.obj}\n");
  EXPECT_EQ(readObjectColors(yaml, FileScope::kOwnFolder), VertexColors({kThree[0]}));
  EXPECT_THROW(
      readObjectColors(write("b.yaml", "object: {visual_mesh: ../mesh.obj}\n"), FileScope::kOwnFolder),
      std::invalid_argument);
}

/// A strip of three triangles.
MeshTopology strip(const std::vector<int>& parents) {
  MeshTopology topology;
  topology.vertex_parents = parents;
  topology.triangles.resize(3, 3);
  topology.triangles << 0, 1, 2, 1, 2, 3, 2, 3, 4;
  return topology;
}

TEST(ColorsOfVertices, followTheParents) {
  const VertexColors colors = colorsOfVertices(strip({2, 0, 1, 2, 0}), kThree);
  EXPECT_EQ(colors, VertexColors({kThree[2], kThree[0], kThree[1], kThree[2], kThree[0]}));
}

TEST(ColorsOfVertices, ofANewVertexAreTheMeanOfItsNeighbours) {
  const VertexColors file{{0, 100, 30}, {100, 100, 60}, {50, 40, 0}, {90, 0, 30}};
  const VertexColors colors =
      colorsOfVertices(strip({0, 1, 2, -1, 3}), file);  // 3 is beside 1 once, 2 twice, 4 once
  EXPECT_EQ(colors[3], (std::array<std::uint8_t, 3>{72, 45, 22}));
}

TEST(ColorsOfVertices, spreadOverSeveralNewVertices) {
  const VertexColors colors = colorsOfVertices(strip({0, -1, -1, -1, -1}), {{7, 8, 9}});
  for (const auto& color : colors) EXPECT_EQ(color, (std::array<std::uint8_t, 3>{7, 8, 9}));
}

TEST(ColorsOfVertices, refuseAnotherFile) {
  EXPECT_THROW(colorsOfVertices(strip({0, 1, 2, 3, 0}), kThree), std::invalid_argument);
  EXPECT_TRUE(colorsOfVertices(strip({0, 1, 2, 3, 0}), {}).empty());
}

}  // namespace
}  // namespace softbody
