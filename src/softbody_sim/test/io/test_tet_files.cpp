#include <fmt/format.h>
#include <test_support/gtest.h>

#include <filesystem>

#include "fixtures/model_files.h"
#include "fixtures/test_meshes.h"
#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_sim/io/surface_files.h"
#include "softbody_sim/io/tet_files.h"

namespace softbody {
namespace {

using test::ScratchFolder;

/// Vertices are numbered 7, 10, 13 ... in files that number them.
constexpr int kFirst = 7, kStep = 3;

std::string numberedVertices(const Points& vertices, const std::string& rest = "") {
  std::string text;
  for (Eigen::Index v = 0; v < vertices.rows(); ++v)
    text += fmt::format("{} {:.17g} {:.17g} {:.17g}{}\n", kFirst + kStep * v, vertices(v, 0), vertices(v, 1),
                        vertices(v, 2), rest);
  return text;
}

/// One line for each tet. @param format of a tet's number and four vertex numbers.
std::string numberedTets(const Tets& tets, const char* format) {
  std::string text;
  const auto id = [&tets](Eigen::Index t, int k) { return kFirst + kStep * tets(t, k); };
  for (Eigen::Index t = 0; t < tets.rows(); ++t)
    text += fmt::format(fmt::runtime(format), t + 1, id(t, 0), id(t, 1), id(t, 2), id(t, 3));
  return text;
}

/// Gmsh's first format, with a triangle and a point among the tets.
std::string writeMsh1(const ScratchFolder& folder, const TetMesh& mesh) {
  return folder.write("body.msh",
                      fmt::format("$NOD\n{}\n{}$ENDNOD\n$ELM\n{}\n1000 2 1 1 3 7 10 13\n1001 15 1 1 1 7\n"
                                  "{}$ENDELM\n",
                                  mesh.vertices.rows(), numberedVertices(mesh.vertices), mesh.tets.rows() + 2,
                                  numberedTets(mesh.tets, "{} 4 1 1 4 {} {} {} {}\n")));
}

/// Gmsh's second format, with the same among the tets, and tags.
std::string writeMsh2(const ScratchFolder& folder, const TetMesh& mesh) {
  return folder.write("body.msh",
                      fmt::format("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{}\n{}$EndNodes\n"
                                  "$Elements\n{}\n1000 2 2 0 1 7 10 13\n1001 15 0 7\n"
                                  "{}$EndElements\n",
                                  mesh.vertices.rows(), numberedVertices(mesh.vertices), mesh.tets.rows() + 2,
                                  numberedTets(mesh.tets, "{} 4 3 1 2 3 {} {} {} {}\n")));
}

/// Gmsh's format 4.1, with a block of a triangle.
std::string writeMsh4(const ScratchFolder& folder, const TetMesh& mesh) {
  std::string ids, places;
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
    ids += fmt::format("{}\n", kFirst + kStep * v);
    places += fmt::format("{:.17g} {:.17g} {:.17g}\n", mesh.vertices(v, 0), mesh.vertices(v, 1),
                          mesh.vertices(v, 2));
  }
  return folder.write(
      "body.msh", fmt::format("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 0 0 1\n1 0 0 0 1 1 1 0 0\n"
                              "$EndEntities\n$Nodes\n1 {0} 7 9999\n3 1 0 {0}\n{1}{2}$EndNodes\n$Elements\n"
                              "2 {3} 1 {3}\n2 1 2 1\n1 7 10 13\n3 1 4 {4}\n{5}$EndElements\n",
                              mesh.vertices.rows(), ids, places, mesh.tets.rows() + 1, mesh.tets.rows(),
                              numberedTets(mesh.tets, "{} {} {} {} {}\n")));
}

/// One line for each vertex and tet, counted from 0. @param prefix of a tet.
std::string plainLists(const TetMesh& mesh, const char* prefix) {
  std::string text;
  for (const auto& p : mesh.vertices.rowwise())
    text += fmt::format("{:.17g} {:.17g} {:.17g}\n", p[0], p[1], p[2]);
  for (const auto& t : mesh.tets.rowwise())
    text += fmt::format("{}{} {} {} {}\n", prefix, t[0], t[1], t[2], t[3]);
  return text;
}

std::string writeGeogram(const ScratchFolder& folder, const TetMesh& mesh) {
  return folder.write("body.tet", fmt::format("{} vertices\n{} tets\n{}", mesh.vertices.rows(),
                                              mesh.tets.rows(), plainLists(mesh, "4 ")));
}

std::string writeQuartet(const ScratchFolder& folder, const TetMesh& mesh) {
  return folder.write("body.TET", fmt::format("\xef\xbb\xbftet {} {}\n{}", mesh.vertices.rows(),
                                              mesh.tets.rows(), plainLists(mesh, "")));
}

std::string writeVeg(const ScratchFolder& folder, const TetMesh& mesh) {
  return folder.write(
      "body.veg",
      fmt::format(
          "# a comment\n\n*VERTICES\n{} 3 0 0\n{}\n*ELEMENTS\nTET\n{} 4 0\n{}\n*MATERIAL defaultMaterial\n"
          "ENU, 1000, 1e7, 0.45\n\n*REGION\nallElements, defaultMaterial\n",
          mesh.vertices.rows(), numberedVertices(mesh.vertices), mesh.tets.rows(),
          numberedTets(mesh.tets, "{} {} {} {} {}\n")));
}

/// With an attribute and a boundary mark for each vertex, and a region for each tet.
std::string writeTetGen(const ScratchFolder& folder, const TetMesh& mesh) {
  folder.write("body.node", fmt::format("{} 3 1 1\n{}# by hand\n", mesh.vertices.rows(),
                                        numberedVertices(mesh.vertices, " 0.5 1")));
  return folder.write(
      "body.ele", fmt::format("{} 4 1\n{}", mesh.tets.rows(), numberedTets(mesh.tets, "{} {} {} {} {} 1\n")));
}

/// Tets of ten nodes. The nodes between corners are the first ones here.
std::string writeQuadratic(const ScratchFolder& folder, const TetMesh& mesh) {
  folder.write("body.node",
               fmt::format("{} 3 0 0\n{}", mesh.vertices.rows(), numberedVertices(mesh.vertices)));
  return folder.write("body.ele", fmt::format("{} 10 0\n{}", mesh.tets.rows(),
                                              numberedTets(mesh.tets, "{} {} {} {} {} 7 7 7 7 7 7\n")));
}

/// With a line of two vertices among the tets.
std::string writeVtuWithLine(const ScratchFolder& folder, const TetMesh& mesh) {
  std::string points, cells = "0 1\n", offsets = "2 ", types = "3 ";
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v)
    points += fmt::format("{:.17g} {:.17g} {:.17g}\n", mesh.vertices(v, 0), mesh.vertices(v, 1),
                          mesh.vertices(v, 2));
  for (Eigen::Index t = 0; t < mesh.tets.rows(); ++t) {
    cells += fmt::format("{} {} {} {}\n", mesh.tets(t, 0), mesh.tets(t, 1), mesh.tets(t, 2), mesh.tets(t, 3));
    offsets += fmt::format("{} ", 2 + 4 * (t + 1));
    types += "10 ";
  }
  const auto array = [](const char* type, const char* name, const std::string& values) {
    return fmt::format("<DataArray type=\"{}\" {} format=\"ascii\">\n{}\n</DataArray>\n", type, name, values);
  };
  return folder.write(
      "body.vtu",
      fmt::format("<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
                  "byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" "
                  "NumberOfCells=\"{}\">\n<Points>\n{}</Points>\n<Cells>\n{}{}{}</Cells>\n</Piece>\n"
                  "</UnstructuredGrid>\n</VTKFile>\n",
                  mesh.vertices.rows(), mesh.tets.rows() + 1,
                  array("Float64", "NumberOfComponents=\"3\"", points),
                  array("Int32", "Name=\"connectivity\"", cells), array("Int32", "Name=\"offsets\"", offsets),
                  array("UInt8", "Name=\"types\"", types)));
}

struct Format {
  const char* name;
  std::string (*write)(const ScratchFolder& folder, const TetMesh& mesh);
  const char* warning;  ///< a part of the text; empty: no warning
};

class TetFormats : public ::testing::TestWithParam<Format> {};

TEST_P(TetFormats, GiveTheSameBodyWithPositiveTetsThatFillTheBoundary) {
  const TetTopology box = testing::boxTopology({7, 5, 4}, {0.21, 0.1, 1.0 / 3.0});
  const ScratchFolder folder;
  Warnings warnings;
  const TetMesh mesh = readTetFile(GetParam().write(folder, {box.rest_vertices, box.tets}), &warnings);
  EXPECT_EQ(mesh.vertices, box.rest_vertices);
  EXPECT_EQ(mesh.tets, box.tets);
  const Eigen::VectorXd volumes = tetVolumes(mesh.vertices, mesh.tets);
  EXPECT_GT(volumes.minCoeff(), 0.0);
  EXPECT_NEAR(enclosedVolume(mesh.vertices, boundaryTriangles(mesh.tets)), volumes.sum(),
              1e-9 * volumes.sum());
  const std::string expected = GetParam().warning;
  if (expected.empty()) {
    EXPECT_TRUE(warnings.empty()) << warnings[0];
  } else {
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_TRUE(says(warnings[0], expected));
  }
}

INSTANTIATE_TEST_SUITE_P(All, TetFormats,
                         ::testing::Values(Format{"Msh1", writeMsh1, "2 elements other than tets"},
                                           Format{"Msh2", writeMsh2, "2 elements other than tets"},
                                           Format{"Msh4", writeMsh4, "1 elements other than tets"},
                                           Format{"Geogram", writeGeogram, ""},
                                           Format{"Quartet", writeQuartet, ""},
                                           Format{"Quadratic", writeQuadratic, "tets have 10 nodes"},
                                           Format{"Veg", writeVeg, "*MATERIAL is ignored"},
                                           Format{"TetGen", writeTetGen, ""},
                                           Format{"Vtu", writeVtuWithLine, "1 cells other than tets"}),
                         [](const auto& info) { return std::string(info.param.name); });

struct Counts {
  const char* file;
  int vertices;
  int elements;
};

/// Those of their README, but for three vertices of the raptor that belong to no tet.
TEST(SharedMeshes, DISABLED_HaveTheCountsOfTheirReadme) {
  for (const Counts& expected : std::initializer_list<Counts>{{"sofa/liver.msh", 181, 596},
                                                              {"sofa/cylinder.msh", 510, 2430},
                                                              {"sofa/Armadillo_Tetra_4406.vtu", 1446, 4406},
                                                              {"sofa/raptorTetra_8418.vtu", 2993, 8418},
                                                              {"sofa/seaMonster2-volume1.vtu", 1175, 3376},
                                                              {"admm/box768.node", 413, 1175},
                                                              {"admm/bunny_1124.ele", 777, 2510},
                                                              {"admm/dillo919.node", 919, 2761},
                                                              {"admm/horse759.node", 962, 3221},
                                                              {"fastcorot/armadillo_4k.node", 1180, 3717},
                                                              {"vega/beam3_tet.veg", 208, 450},
                                                              {"../../toys/toy_tets.vtu", 961, 3068}}) {
    Warnings warnings;
    const TetMesh mesh = readTetFile(test::sharedData("meshes/tet/") + expected.file, &warnings);
    EXPECT_EQ(mesh.vertices.rows(), expected.vertices) << expected.file;
    EXPECT_EQ(mesh.tets.rows(), expected.elements) << expected.file;
  }
}

TEST(SharedMeshes, DISABLED_AllReadWithPositiveTetsThatFillTheirBoundary) {
  int surfaces = 0, tet_meshes = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(test::sharedData("meshes"))) {
    const std::string path = entry.path().string(), extension = entry.path().extension().string();
    Warnings warnings;
    if (extension == ".obj") {
      EXPECT_GT(readSurfaceFile(path, &warnings).mesh.triangles.rows(), 0) << path;
      ++surfaces;
    } else if ((extension == ".vtu" || extension == ".msh" || extension == ".node" || extension == ".veg") &&
               entry.path().stem() != "beam3") {  // of hexahedra
      const TetMesh mesh = readTetFile(path, &warnings);
      const Eigen::VectorXd volumes = tetVolumes(mesh.vertices, mesh.tets);
      EXPECT_GT(volumes.minCoeff(), 0.0) << path;
      EXPECT_NEAR(enclosedVolume(mesh.vertices, boundaryTriangles(mesh.tets)), volumes.sum(),
                  1e-9 * volumes.sum())
          << path;
      ++tet_meshes;
    }
  }
  EXPECT_GE(surfaces, 14);
  EXPECT_GE(tet_meshes, 17);
}

}  // namespace
}  // namespace softbody
