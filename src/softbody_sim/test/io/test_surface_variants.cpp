#include <fmt/format.h>
#include <test_support/gtest.h>

#include <cstring>

#include "fixtures/model_files.h"
#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_sim/io/surface_files.h"

namespace softbody {
namespace {

using test::ScratchFolder;

/// A box of eight vertices and six quadrilaterals: 3 cm^3 in cm.
constexpr double kBoxCorners[8][3] = {{0, 0, 0}, {0, 0, 1}, {0, 1, 0}, {0, 1, 1},
                                      {3, 0, 0}, {3, 0, 1}, {3, 1, 0}, {3, 1, 1}};
constexpr int kBoxSides[6][4] = {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1},
                                 {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}};

/// @param vertex with three numbers. @param corner of faces, with its number, and the side's corner.
std::string lists(const char* vertex, const char* face, const char* corner, const char* end, int first) {
  std::string text;
  for (const auto& p : kBoxCorners) text += fmt::format(fmt::runtime(vertex), p[0], p[1], p[2]) + end;
  for (const auto& side : kBoxSides) {
    text += face;
    for (int k = 0; k < 4; ++k) text += fmt::format(fmt::runtime(corner), side[k] + first, k + 1);
    text += end;
  }
  return text;
}

std::string obj(const char* corner = " {}", const char* end = "\n", const char* vertex = "v {} {} {}") {
  return lists(vertex, "f", corner, end, 1);
}

std::string off(const std::string& header, const char* vertex = "{} {} {}", const char* end = "\n") {
  return header + end + lists(vertex, "4", " {}", end, 0);
}

std::string plyHeader(const std::string& more_of_vertices, const std::string& more_of_faces,
                      const char* end) {
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n" +
      more_of_vertices + "element face 6\nproperty list uchar int vertex_indices\n" + more_of_faces +
      "end_header\n";
  std::string ended;
  for (const char c : text) ended += c == '\n' ? std::string(end) : std::string(1, c);
  return ended;
}

std::string stl(const char* line = "{}\n", const char* last = "endsolid box\n") {
  std::string text = fmt::format(fmt::runtime(line), "solid box");
  for (const auto& s : kBoxSides) {
    for (int k = 2; k < 4; ++k) {
      text += fmt::format(fmt::runtime(line), "facet normal nan 0 -nan(ind)") +
              fmt::format(fmt::runtime(line), "outer loop");
      for (const int v : {s[0], s[k - 1], s[k]})
        text += fmt::format(fmt::runtime(line), fmt::format("vertex {:E} {:+e} {}", kBoxCorners[v][0],
                                                            kBoxCorners[v][1], kBoxCorners[v][2]));
      text += fmt::format(fmt::runtime(line), "endloop") + fmt::format(fmt::runtime(line), "endfacet");
    }
  }
  return text + last;
}

std::string binaryStl(std::string head, std::uint32_t count, const std::string& tail) {
  head.resize(80, ' ');
  head.append(reinterpret_cast<const char*>(&count), sizeof(count));
  for (const auto& s : kBoxSides) {
    for (int k = 2; k < 4; ++k) {
      float numbers[12] = {NAN, 0, 0};
      float* next = numbers + 3;
      for (const int v : {s[0], s[k - 1], s[k]}) next = std::copy_n(kBoxCorners[v], 3, next);
      head.append(reinterpret_cast<const char*>(numbers), sizeof(numbers)).append(2, '\0');
    }
  }
  return head + tail;
}

std::string upper(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(c));
  return text;
}

std::string doubled(const std::string& text) {  // UTF-16
  std::string wide = "\xff\xfe";
  for (const char c : text) wide.append(1, c).append(1, '\0');
  return wide;
}

const std::string kBom = "\xef\xbb\xbf";
const std::string kTexture = "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";
/// Each side has its texture coordinates behind its corners.
std::string wedges() {
  std::string text = lists("{} {} {}", "4", " {}", "\n", 0);
  for (std::size_t at = text.find("\n4"); at != std::string::npos; at = text.find("\n4", at + 1))
    text.insert(text.find('\n', at + 1), " 8 0 0 1 0 1 1 0 1");
  return text;
}

struct Variant {
  std::string file, bytes;
  bool has_texture = false;
  int vertices = 8;
  int warnings = 0;
};

class Variants : public testing::TestWithParam<Variant> {};

TEST_P(Variants, AreTheSameBody) {
  const ScratchFolder folder;
  Warnings warnings;
  const SurfaceFile file = readSurfaceFile(folder.write(GetParam().file, GetParam().bytes), &warnings);
  ASSERT_EQ(file.mesh.vertices.rows(), GetParam().vertices);
  if (GetParam().vertices < 36) {  // in file order
    for (int v = 0; v < 8; ++v)
      EXPECT_EQ(file.mesh.vertices.row(v),
                Eigen::RowVector3d(kBoxCorners[v][0], kBoxCorners[v][1], kBoxCorners[v][2]));
  }
  EXPECT_EQ(file.mesh.triangles.rows(), 12);
  EXPECT_NEAR(enclosedVolume(file.mesh.vertices, file.mesh.triangles), 3.0, 1e-6);
  EXPECT_EQ(file.texture_coordinates.rows(), GetParam().has_texture ? 36 : 0);
  EXPECT_EQ(static_cast<int>(warnings.size()), GetParam().warnings) << testing::PrintToString(warnings);
}

INSTANTIATE_TEST_SUITE_P(
    Obj, Variants,
    testing::Values(Variant{"bom.obj", kBom + obj()}, Variant{"cr.obj", obj(" {}", "\r")},
                    Variant{"crlf.OBJ", obj(" {}", "\r\n") + std::string("\0\x1a", 2)},
                    Variant{"indented.obj", obj(" {}", "\n \t")},
                    Variant{"colours.obj", obj(" {}", "\n", "v {} {} {} 1 0 .5")},
                    Variant{"weights.obj", obj(" {}", "\n", "v {} {} {} 1.0")},
                    Variant{"upper.obj", upper(obj())},
                    Variant{"names.obj", "o C:\\a\\\ng C:\\scans\\\nusemtl b\\\n# c \\\n" + obj()},
                    Variant{"continued.obj", obj(" \\\n{}")},
                    Variant{"normals.obj", "vn nan -1.#IND inf\n" + obj(" {}//1")},
                    Variant{"texture.obj", kTexture + obj(" {}/{}"), true},
                    Variant{"nan_texture.obj", "vt -nan(ind) inf\nvt 1 0\nvt 1 1\nvt 0 1\n" + obj(" {}/{}/1"),
                            true, 8, 1},
                    Variant{"mixed.obj", kTexture + obj(" {}/{}") + "f 1 2 2\nf 3\nl 1 2\n", true, 8, 2},
                    Variant{"unused.obj", obj() + "v nan inf 1e999\n", false, 9, 1}));

INSTANTIATE_TEST_SUITE_P(
    Off, Variants,
    testing::Values(Variant{"plain.off", kBom + off("off # a\n\n8 6 12 # b")},
                    Variant{"no_word.off", off("8 6")}, Variant{"cr.off", off("OFF 8 6 0", "{} {} {}", "\r")},
                    Variant{"COFF.off", off("COFF\n8 6 0", "{} {} {} 255 0 0 255")},
                    Variant{"CNOFF.off", off("CNOFF\n8 6 0", "{} {} {} nan 0 1 0.1 0 0")},
                    Variant{"STOFF.off", off("STCNOFF 8 6 0", "{} {} {} 0 0 1 9 9 9 .5 .25"), true}));

INSTANTIATE_TEST_SUITE_P(
    Ply, Variants,
    testing::Values(
        Variant{"bom.ply", kBom + plyHeader("", "", "\n") + lists("{} {} {}", "4", " {}", "\n", 0)},
        Variant{"cr.ply", plyHeader("", "", "\r") + lists("{} {} {}", "4", " {}", "\r", 0)},
        Variant{"crlf.ply",
                plyHeader("property float nx\n", "", "\r\n") + lists("{} {} {} nan", "4", " {}", "\r\n", 0)},
        Variant{"wedges.ply", plyHeader("", "property list uchar float texcoord\n", "\n") + wedges(), true},
        Variant{"vertices.ply",
                plyHeader("property float s\nproperty float t\n", "", "\n") +
                    lists("{} {} {} 1 0", "4", " {}", "\n", 0),
                true}));

INSTANTIATE_TEST_SUITE_P(
    Stl, Variants,
    testing::Values(Variant{"bom.stl", kBom + stl(), false, 36},
                    Variant{"upper.stl", upper(stl()), false, 36},
                    Variant{"indented.stl", stl("\t {}\r\n"), false, 36},
                    Variant{"blank.stl", "\n\n" + stl("{}\r", "end solid\r"), false, 36},
                    Variant{"no_end.stl", stl("{}\n", ""), false, 36, 1},
                    Variant{"binary.stl", binaryStl("box", 12, ""), false, 36},
                    Variant{"solid.stl", binaryStl("solid facet", 12, "ab"), false, 36},
                    Variant{"tail.stl", binaryStl("box", 12, std::string(100, 'x')), false, 36},
                    Variant{"no_solid.stl", stl().substr(10), false, 36},
                    Variant{"small_count.stl", binaryStl("box", 7, ""), false, 36, 1},
                    Variant{"no_count.stl", binaryStl("solid box", 0, ""), false, 36, 1},
                    Variant{"any_count.stl", binaryStl("box", 0xffffffff, ""), false, 36, 1}));

TEST(UnreadableVariants, AreNamed) {
  const ScratchFolder folder;
  Warnings warnings;
  const std::vector<std::array<std::string, 3>> files{
      {"a.obj", doubled(obj()), "is UTF-16 text"},
      {"a.stl", doubled(stl()), "is UTF-16 text"},
      {"a.ply", doubled("ply\n"), "is UTF-16 text"},
      {"b.obj", obj() + "f 1 2 9\n", "b.obj:15: a face refers to vertex 8, counted from 0; the file has 8"},
      {"a.off", off("4OFF 8 6 0", "{} {} {} 1"), ":1: 4OFF has vertices of another dimension"},
      {"b.off", off("nOFF\n3\n8 6 0"), ":1: nOFF has vertices of another dimension"},
      {"c.off", "OFF BINARY\n", ":1: binary OFF"},
      {"b.ply",
       "ply\nformat ascii 1.0\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n1 0\n",
       "triangle strips"},
      {"a.dae", "", "Blender"},
      {"a.STEP", "", "FreeCAD"},
      {"a.vtk", "", "meshio"},
      {"a.msh", "", "tet_mesh"}};
  for (const auto& [name, bytes, sentence] : files) {
    const std::string path = folder.write(name, bytes);
    const std::string said = complaint([&] { readSurfaceFile(path, &warnings); });
    EXPECT_TRUE(says(said, sentence)) << name;
  }
}

}  // namespace
}  // namespace softbody
