#include <test_support/gtest.h>

#include <cstring>
#include <random>

#include "fixtures/model_files.h"
#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_sim/io/surface_files.h"
#include "softbody_sim/io/tet_files.h"
#include "softbody_sim/io/textured_mesh_file.h"

namespace softbody {
namespace {

using test::ScratchFolder;

constexpr const char* kQuadObj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf -4 -3 -2 -1\n";

TEST(ReadObj, TriangulatesPolygonsAndResolvesNegativeIndices) {
  const ScratchFolder folder;
  Warnings warnings;
  const SurfaceFile quad = readSurfaceFile(folder.write("quad.obj", kQuadObj), &warnings);
  EXPECT_EQ(quad.mesh.vertices.rows(), 4);
  EXPECT_EQ(quad.mesh.triangles, (Triangles(2, 3) << 0, 1, 2, 0, 2, 3).finished());
  EXPECT_TRUE(warnings.empty());
}

TEST(ReadObj, KeepsTextureCoordinatesPerCorner) {
  const ScratchFolder folder;
  Warnings warnings;
  const SurfaceFile file = readSurfaceFile(
      folder.write("a.obj",
                   "v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nvt 0.25 0.5\r\nvt 1 0\r\nf 1/2/1 2/1 \\\r\n3/1\r\n"),
      &warnings);
  ASSERT_EQ(file.texture_coordinates.rows(), 3);
  EXPECT_EQ(file.texture_coordinates.row(0), Eigen::RowVector3d(1, 0, 0));
  EXPECT_EQ(file.texture_coordinates.row(2), Eigen::RowVector3d(0.25, 0.5, 0));
}

TEST(ReadObj, WarnsOfCornersWithoutTextureCoordinates) {
  const ScratchFolder folder;
  Warnings warnings;
  const std::string path = folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/7\n");
  EXPECT_EQ(readSurfaceFile(path, &warnings).texture_coordinates, Points(Points::Zero(3, 3)));
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_TRUE(says(warnings[0], "a.obj: 1 of 3 triangle corners"));
}

TEST(WriteObj, ReadsBackBitForBit) {
  const ScratchFolder folder;
  const TriangleMesh mesh = test::torus(1.0 / 3.0, 0.1, 17, 9);
  const Points texture = Points::Random(3 * mesh.triangles.rows(), 3).array().rowwise() *
                         Eigen::Array3d(1.0, 1.0, 0.0).transpose();
  writeObj(folder.file("torus.obj"), mesh, {texture});
  Warnings warnings;
  const SurfaceFile read = readSurfaceFile(folder.file("torus.obj"), &warnings);
  EXPECT_EQ(read.mesh.vertices, mesh.vertices);
  EXPECT_EQ(read.mesh.triangles, mesh.triangles);
  EXPECT_TRUE(read.texture_coordinates.isApprox(texture, 1e-8));
}

TEST(WriteTexturedObj, TheReadersFindThePicture) {
  const ScratchFolder folder;
  const TriangleMesh mesh = test::torus(1.0, 0.3, 8, 6);
  const cv::Mat3b picture(5, 7, cv::Vec3b(1, 2, 3));
  writeTexturedObj(folder.file("a.obj"), mesh, Points::Zero(3 * mesh.triangles.rows(), 3), picture);
  Warnings warnings;
  const SurfaceFile read = readSurfaceFile(folder.file("a.obj"), &warnings);
  const SurfacePictures pictures = surfacePictures(read, FileScope::kOwnFolder, &warnings);
  EXPECT_EQ(pictures.files, std::vector<std::string>{folder.file("a.png")});
  EXPECT_EQ(pictures.picture, std::vector<int>(static_cast<std::size_t>(mesh.triangles.rows()), 0));
  EXPECT_TRUE(warnings.empty());
  EXPECT_THROW(writeTexturedObj(folder.file("b.obj"), mesh, {}, cv::Mat3b()), std::runtime_error);
  EXPECT_FALSE(std::filesystem::exists(folder.file("b.obj")));
}

TEST(ReadPly, AScanSaysWhatWasSeen) {
  const ScratchFolder folder;
  Warnings warnings;
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
  const std::string faces = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const std::string with =
      header + "property float seen\n" + faces + "0 0 0 1\n1 0 0 0.5\n0 1 0 0\n3 0 1 2\n";
  const std::string without = header + faces + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  EXPECT_EQ(readSurfaceFile(folder.write("a.ply", with), &warnings).seen,
            (std::vector<float>{1.0f, 0.5f, 0.0f}));
  EXPECT_TRUE(readSurfaceFile(folder.write("b.ply", without), &warnings).seen.empty());
}

constexpr const char* kPlyHeader =
    "element vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n";

template <typename T>
void append(std::string* bytes, T value, bool swap) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  if (swap) std::reverse(raw, raw + sizeof(T));
  bytes->append(raw, sizeof(T));
}

std::string binaryPly(bool big_endian) {
  std::string bytes =
      std::string("ply\nformat binary_") + (big_endian ? "big" : "little") + "_endian 1.0\n" + kPlyHeader;
  const float corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  for (const auto& corner : corners) {
    for (const float x : corner) append(&bytes, x, big_endian);
    bytes.push_back('\x7f');
  }
  bytes.push_back('\x04');
  for (const std::int32_t corner : {0, 1, 2, 3}) append(&bytes, corner, big_endian);
  return bytes;
}

TEST(ReadPly, AsciiAndBothByteOrdersAgreeWithObj) {
  const ScratchFolder folder;
  Warnings warnings;
  const SurfaceFile obj = readSurfaceFile(folder.write("quad.obj", kQuadObj), &warnings);
  const std::string ascii = std::string("ply\nformat ascii 1.0\ncomment x\n") + kPlyHeader +
                            "0 0 0 1\n1 0 0 1\n1 1 0 1\n0 1 0 1\n4 0 1 2 3\n";
  for (const std::string& content : {ascii, binaryPly(false), binaryPly(true)}) {
    const SurfaceFile ply = readSurfaceFile(folder.write("quad.ply", content), &warnings);
    EXPECT_EQ(ply.mesh.vertices, obj.mesh.vertices);
    EXPECT_EQ(ply.mesh.triangles, obj.mesh.triangles);
  }
}

TEST(ReadOff, AgreesWithObj) {
  const ScratchFolder folder;
  Warnings warnings;
  const SurfaceFile obj = readSurfaceFile(folder.write("quad.obj", kQuadObj), &warnings);
  const SurfaceFile off = readSurfaceFile(
      folder.write("quad.OFF", "OFF\n# square\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3 255 0 0\n"),
      &warnings);
  EXPECT_EQ(off.mesh.vertices, obj.mesh.vertices);
  EXPECT_EQ(off.mesh.triangles, obj.mesh.triangles);
}

std::string binaryStl() {
  std::string bytes = "solid, though binary";
  bytes.resize(80, ' ');
  append(&bytes, std::uint32_t{1}, false);
  for (const float x : {0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0}) append(&bytes, x, false);
  append(&bytes, std::uint16_t{0}, false);
  return bytes;
}

TEST(ReadStl, AsciiAndBinaryAgree) {
  const ScratchFolder folder;
  Warnings warnings;
  const std::string ascii =
      "solid a b\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
      "0\nendloop\nendfacet\nendsolid\n";
  const SurfaceFile from_ascii = readSurfaceFile(folder.write("a.stl", ascii), &warnings);
  const SurfaceFile from_binary = readSurfaceFile(folder.write("b.stl", binaryStl()), &warnings);
  EXPECT_EQ(from_ascii.mesh.vertices, from_binary.mesh.vertices);
  EXPECT_EQ(from_ascii.mesh.triangles, from_binary.mesh.triangles);
}

TEST(WriteVtu, ReadsBackBitForBit) {
  const ScratchFolder folder;
  TetMesh mesh{Points::Random(5, 3) / 3.0, Tets(2, 4)};
  mesh.tets << 0, 1, 2, 3, 1, 2, 3, 4;
  const Eigen::VectorXd volumes = tetVolumes(mesh.vertices, mesh.tets);
  for (int t = 0; t < 2; ++t) {
    if (volumes[t] < 0.0) std::swap(mesh.tets(t, 2), mesh.tets(t, 3));
  }
  writeVtu(folder.file("a.vtu"), mesh);
  Warnings warnings;
  const TetMesh read = readTetFile(folder.file("a.vtu"), &warnings);
  EXPECT_EQ(read.vertices, mesh.vertices);
  EXPECT_EQ(read.tets, mesh.tets);
  EXPECT_TRUE(warnings.empty());
}

TEST(ReadTetFile, TurnsDropsAndSaysSo) {
  const ScratchFolder folder;
  folder.write("a.node", "6 3 0 0\n10 0 0 0\n20 1 0 0\n30 0 1 0\n40 0 0 1\n50 1 1 0\n60 9 9 9\n");
  folder.write("a.ele", "3 4 0\n1 10 20 30 40\n2 50 20 30 40\n3 10 20 30 50\n");
  Warnings warnings;
  const TetMesh mesh = readTetFile(folder.file("a.ele"), &warnings);
  EXPECT_EQ(mesh.vertices.rows(), 5);
  EXPECT_EQ(mesh.tets.rows(), 2);
  EXPECT_GT(tetVolumes(mesh.vertices, mesh.tets).minCoeff(), 0.0);
  EXPECT_EQ(warnings.size(), 3U);  // one flat, one turned, one vertex unused
}

struct BadSurface {
  const char* name;
  std::string content;
  const char* place;
};

class BrokenSurface : public testing::TestWithParam<BadSurface> {};

TEST_P(BrokenSurface, IsRefusedWithFileAndPlace) {
  const ScratchFolder folder;
  Warnings warnings;
  const std::string path = folder.write(GetParam().name, GetParam().content);
  const std::string said = complaint([&] { readSurfaceFile(path, &warnings); });
  EXPECT_TRUE(says(said, path));
  EXPECT_TRUE(says(said, GetParam().place));
}

INSTANTIATE_TEST_SUITE_P(
    Files, BrokenSurface,
    testing::Values(
        BadSurface{"empty.obj", "", "no faces"},
        BadSurface{"nan.obj", "v 0 0 0\nv 1 nan 0\nv 0 1 0\nf 1 2 3\n", ":2: 'nan'"},
        BadSurface{"short.obj", "v 0 0\n", ":1: 3 fields"},
        BadSurface{"range.obj", "v 0 0 0\n\nf 1 2 3\n", ":3: a face refers to"},
        BadSurface{"zero.obj", "v 0 0 0\nf 0 1 1\n", ":2: face corner '0'"},
        BadSurface{"negative.obj", "v 0 0 0\nf -2 -1 -1\n", ":2: face corner '-2'"},
        BadSurface{"two.obj", "v 0 0 0\nf 1 1\n", "1 vertices and no faces"},
        BadSurface{"word.obj", "v 0 0 0\nf 1 x 1\n", ":2: 'x'"},
        BadSurface{"count.off", "OFF\n2000000000 1 0\n0 0 0\n", ":2: announces 2000000000"},
        BadSurface{"end.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n", ":4: the file ends before vertex 3 of 3"},
        BadSurface{"index.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n",
                   ":6: a face refers to vertex 3"},
        BadSurface{"count.ply",
                   "ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nend_header\n",
                   "line 3: announces"},
        BadSurface{"list.ply",
                   "ply\nformat ascii 1.0\nelement face 1\nproperty list uint int "
                   "vertex_indices\nend_header\n4000000000 1\n",
                   "face 0 of 1: a list of"},
        BadSurface{"end.ply", binaryPly(false).substr(0, binaryPly(false).size() - 18),
                   "vertex 3 of 4: the file ends"},
        BadSurface{"doubles.ply",
                   "ply\nformat binary_little_endian 1.0\nelement face 1\nproperty list uchar double "
                   "vertex_indices\nend_header\n\x40" +
                       std::string(511, '\0'),
                   "face 0 of 1: a list of 64 entries does not fit into the rest of the file"},
        BadSurface{"type.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty quad x\nend_header\n",
                   "line 4"},
        BadSurface{"end.stl", binaryStl().substr(0, 120), "announces 1 facets, but ends after 0"},
        BadSurface{"end2.stl", "solid\nfacet\nvertex 0 0 0\nvertex 1 0 0\nendfacet\nendsolid\n",
                   ":5: a facet without"},
        BadSurface{"what.xyz", "1 2 3\n", "supported: .obj"}));

class BrokenTets : public testing::TestWithParam<BadSurface> {};

TEST_P(BrokenTets, IsRefusedWithFileAndPlace) {
  const ScratchFolder folder;
  Warnings warnings;
  const std::string path = folder.write(GetParam().name, GetParam().content);
  const std::string said = complaint([&] { readTetFile(path, &warnings); });
  EXPECT_TRUE(says(said, path));
  EXPECT_TRUE(says(said, GetParam().place));
}

std::string vtu(const std::string& points, const std::string& connectivity, const std::string& offsets,
                const std::string& format = "ascii") {
  return "<VTKFile><UnstructuredGrid><Piece NumberOfPoints=\"4\" NumberOfCells=\"1\"><Points><DataArray "
         "format=\"" +
         format + "\">" + points + "</DataArray></Points><Cells><DataArray Name=\"connectivity\">" +
         connectivity + "</DataArray><DataArray Name=\"offsets\">" + offsets +
         "</DataArray><DataArray Name=\"types\">10</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>";
}

/// A mesh among whose elements others lie in each other.
std::string nested(int depth) {
  std::string begin, end;
  for (int k = 0; k < depth; ++k) {
    begin += "<a>";
    end += "</a>";
  }
  return "<VTKFile>" + begin + end + "<UnstructuredGrid/></VTKFile>";
}

constexpr const char* kCorners = "0 0 0 1 0 0 0 1 0 0 0 1";

INSTANTIATE_TEST_SUITE_P(
    Files, BrokenTets,
    testing::Values(
        BadSurface{"a.vtu", "<VTKFile>\n<Unstr", ":2: not XML"},
        BadSurface{"deep.vtu", nested(100000), ":1: not XML (XML_ELEMENT_DEPTH_EXCEEDED)"},
        BadSurface{"open.vtu", "<a>\n<b>\n</b>", ":1: not XML (XML_ERROR_PARSING)"},
        BadSurface{"crossed.vtu", "<a><b></a></b>", "XML_ERROR_MISMATCHED_ELEMENT"},
        BadSurface{"quote.vtu", "<a b=c/>", "XML_ERROR_PARSING_ATTRIBUTE"},
        BadSurface{"b.vtu", "<VTKFile/>", "no <UnstructuredGrid>"},
        BadSurface{"c.vtu", vtu("0 0 0", "0 1 2 3", "4"), "NumberOfPoints is 4"},
        BadSurface{"d.vtu", vtu(kCorners, "0 1 2 4", "4"), "cell 0: refers to point 4"},
        BadSurface{"e.vtu", vtu(kCorners, "0 1 2 3", "9"), "cell 0: offset 9"},
        BadSurface{"f.vtu", vtu("0 0 inf", "0 1 2 3", "4"), "entry 2: 'inf'"},
        BadSurface{"g.vtu", vtu(kCorners, "0 1 2 3", "4", "appended"), "format is 'appended'"},
        BadSurface{"h.vtu", vtu("0 0 0 1 0 0 0 1 0 1 1 0", "0 1 2 3", "4"), "no tet of positive volume"},
        BadSurface{"a.msh", "$MeshFormat\n4 0 8\n$EndMeshFormat\n",
                   ":2: MSH version 4 is not supported; supported: 1, 2 and 4.1; convert it: gmsh"},
        BadSurface{"b.msh", "$MeshFormat\n2.2 1 8\n", ":2: binary MSH"},
        BadSurface{"c.msh", "$Nodes\n900000000\n1 0 0 0\n", ":2: announces"},
        BadSurface{"d.msh", "$Nodes\n1\n7 0 0 0\n$EndNodes\n$Elements\n1\n1 4 2 0 1 7 7 7 8\n",
                   ":7: a tet refers to vertex 8"},
        BadSurface{"e.msh", "$Nodes\n2\n7 0 0 0\n7 0 0 1\n", ":4: two vertices have the id 7"},
        BadSurface{"a.veg", "*VERTICES\n1 3 0 0\n1 0 0 0\n*ELEMENTS\nCUBIC\n1 8 0\n",
                   ":5: elements of kind CUBIC"},
        BadSurface{"a.node", "1 2 0 0\n", ":1: the vertices must be three"},
        BadSurface{"a.tet", "4 vertices\n1 tets\n0 0 0\n", ":3: the file ends before vertex 2 of 4"},
        BadSurface{"b.tet", "tet 1 1\n0 0 0\n8 0 0 0 0 0 0 0 0\n", ":3: a cell of 8 vertices"},
        BadSurface{"a.mesh", "", "supported: .vtu"}));

/// Whatever the bytes: a sound mesh, or a sentence.
TEST(DamagedFiles, AreReadSoundlyOrRefused) {
  const ScratchFolder folder;
  const std::vector<std::pair<std::string, std::string>> seeds{
      {"a.obj", kQuadObj},
      {"a.off", "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n"},
      {"a.ply", binaryPly(false)},
      {"b.ply", std::string("ply\nformat ascii 1.0\n") + kPlyHeader +
                    "0 0 0 1\n1 0 0 1\n1 1 0 1\n0 1 0 1\n4 0 1 2 3\n"},
      {"a.stl", binaryStl()},
      {"a.vtu", vtu(kCorners, "0 1 2 3", "4")},
      {"a.msh",
       "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n9 0 0 1\n$EndNodes\n$Elements\n1\n1 4 2 0 1 1 2 3 9\n"},
      {"a.veg",
       "*VERTICES\n4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n*ELEMENTS\nTET\n1 4 0\n1 1 2 3 4\n"}};
  std::mt19937 random(3);
  for (int trial = 0; trial < 1000; ++trial) {
    auto [name, bytes] = seeds[random() % seeds.size()];
    for (unsigned edits = 1 + random() % 3; edits > 0; --edits) {
      bytes[random() % bytes.size()] =
          static_cast<char>(random() % 2 == 0 ? '0' + random() % 10 : random() % 256);
    }
    if (random() % 4 == 0) bytes.resize(random() % bytes.size());
    const std::string path = folder.write(name, bytes);
    Warnings warnings;
    try {
      if (name == "a.vtu" || name == "a.msh" || name == "a.veg") {
        const TetMesh mesh = readTetFile(path, &warnings);
        EXPECT_GT(tetVolumes(mesh.vertices, mesh.tets).minCoeff(), 0.0);
      } else {
        const TriangleMesh mesh = readSurfaceFile(path, &warnings).mesh;
        EXPECT_TRUE(mesh.vertices.allFinite());
        EXPECT_GE(mesh.triangles.minCoeff(), 0);
        EXPECT_LT(mesh.triangles.maxCoeff(), mesh.vertices.rows());
      }
    } catch (const std::invalid_argument& error) {
      EXPECT_TRUE(says(error.what(), path));
    }
  }
}

}  // namespace
}  // namespace softbody
