#include "corpus/broken_meshes.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <stdexcept>

#include "surface_mesh/surface_repair.h"

namespace softbody::test {
namespace {

constexpr int kRings = 12, kSides = 6;

TriangleMesh smallTorus(double x = 0.0) {
  TriangleMesh mesh{Points(kRings * kSides, 3), Triangles(2 * kRings * kSides, 3)};
  for (int i = 0; i < kRings; ++i) {
    for (int j = 0; j < kSides; ++j) {
      const double u = 2.0 * M_PI * i / kRings, v = 2.0 * M_PI * j / kSides, r = 0.1 + 0.04 * std::cos(v);
      mesh.vertices.row(i * kSides + j) << x + r * std::cos(u), r * std::sin(u), 0.04 * std::sin(v);
      const auto at = [](int ring, int side) { return ring % kRings * kSides + side % kSides; };
      mesh.triangles.row(2 * (i * kSides + j)) << at(i, j), at(i + 1, j), at(i + 1, j + 1);
      mesh.triangles.row(2 * (i * kSides + j) + 1) << at(i, j), at(i + 1, j + 1), at(i, j + 1);
    }
  }
  return mesh;
}

std::string asObj(const TriangleMesh& mesh) {
  std::string text;
  for (const auto& p : mesh.vertices.rowwise()) text += fmt::format("v {} {} {}\n", p[0], p[1], p[2]);
  for (const auto& t : mesh.triangles.rowwise())
    text += fmt::format("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  return text;
}

std::string asOff(const TriangleMesh& mesh) {
  std::string text = fmt::format("OFF\n{} {} 0\n", mesh.vertices.rows(), mesh.triangles.rows());
  for (const auto& p : mesh.vertices.rowwise()) text += fmt::format("{} {} {}\n", p[0], p[1], p[2]);
  for (const auto& t : mesh.triangles.rowwise()) text += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
  return text;
}

template <typename T>
void appendBytes(T value, std::string* bytes) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  bytes->append(raw, sizeof(T));
}

std::string asPly(const TriangleMesh& mesh, bool binary) {
  std::string bytes = fmt::format(
      "ply\nformat {} 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      binary ? "binary_little_endian" : "ascii", mesh.vertices.rows(), mesh.triangles.rows());
  for (const auto& p : mesh.vertices.rowwise()) {
    if (!binary) bytes += fmt::format("{} {} {}\n", p[0], p[1], p[2]);
    for (int k = 0; k < 3 && binary; ++k) appendBytes(static_cast<float>(p[k]), &bytes);
  }
  for (const auto& t : mesh.triangles.rowwise()) {
    if (!binary) bytes += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
    if (binary) bytes += '\3';
    for (int k = 0; k < 3 && binary; ++k) appendBytes(t[k], &bytes);
  }
  return bytes;
}

std::string asStl(const TriangleMesh& mesh, bool binary) {
  std::string bytes = binary ? std::string(80, ' ') : "solid a\n";
  if (binary) appendBytes(static_cast<std::uint32_t>(mesh.triangles.rows()), &bytes);
  for (const auto& t : mesh.triangles.rowwise()) {
    if (binary) bytes += std::string(12, '\0');
    if (!binary) bytes += "facet normal 0 0 0\nouter loop\n";
    for (const int v : t) {
      const auto p = mesh.vertices.row(v);
      if (!binary) bytes += fmt::format("vertex {} {} {}\n", p[0], p[1], p[2]);
      for (int k = 0; k < 3 && binary; ++k) appendBytes(static_cast<float>(p[k]), &bytes);
    }
    bytes += binary ? std::string(2, '\0') : "endloop\nendfacet\n";
  }
  return binary ? bytes : bytes + "endsolid a\n";
}

TriangleMesh both(const TriangleMesh& a, const TriangleMesh& b) {
  TriangleMesh mesh{Points(a.vertices.rows() + b.vertices.rows(), 3),
                    Triangles(a.triangles.rows() + b.triangles.rows(), 3)};
  mesh.vertices << a.vertices, b.vertices;
  mesh.triangles << a.triangles, b.triangles.array() + static_cast<int>(a.vertices.rows());
  return mesh;
}

TriangleMesh turned(TriangleMesh mesh, Eigen::Index every) {
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); f += every) {
    std::swap(mesh.triangles(f, 1), mesh.triangles(f, 2));
  }
  return mesh;
}

TriangleMesh withTriangles(const Triangles& triangles) { return {smallTorus().vertices, triangles}; }

/// Every triangle has its own corners, with rounding errors.
TriangleMesh unwelded() {
  const TriangleMesh torus = smallTorus();
  TriangleMesh mesh{Points(torus.triangles.size(), 3), Triangles(torus.triangles.rows(), 3)};
  for (Eigen::Index f = 0; f < torus.triangles.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      mesh.triangles(f, k) = static_cast<int>(3 * f) + k;
      mesh.vertices.row(3 * f + k) = torus.vertices.row(torus.triangles(f, k)) * (1.0 + 1e-9 * k);
    }
  }
  return mesh;
}

/// A third triangle on an edge.
TriangleMesh withFin() {
  TriangleMesh mesh = both(smallTorus(), {(Points(1, 3) << 0.2, 0.0, 0.0).finished(), Triangles(0, 3)});
  mesh.triangles.conservativeResize(mesh.triangles.rows() + 1, Eigen::NoChange);
  mesh.triangles.bottomRows(1) << 0, kSides, static_cast<int>(mesh.vertices.rows()) - 1;
  return mesh;
}

void addRefused(std::vector<BrokenFile>* files) {
  const std::string ply = asPly(smallTorus(), false), binary_ply = asPly(smallTorus(), true);
  const std::string stl = asStl(smallTorus(), false), binary_stl = asStl(smallTorus(), true);
  const std::string many =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 10000000\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n";
  std::string many_stl(80, ' ');
  appendBytes(std::uint32_t{10000000}, &many_stl);
  for (const char* extension : {"obj", "off", "ply", "stl"}) {
    files->push_back({fmt::format("empty.{}", extension), "", fmt::format("empty.{}", extension)});
  }
  files->push_back({"no_faces.obj", "v 0 0 0\nv 1 0 0\n", "no faces"});
  files->push_back({"nan.obj", "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", ":1: 'nan' is not a finite number"});
  files->push_back(
      {"infinite.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1e999 0\n3 0 1 2\n", "is not a finite number"});
  files->push_back({"ten_million.off", "OFF\n3 10000000 0\n0 0 0\n", "announces 10000000"});
  files->push_back({"ten_million.ply", many, "10000000"});
  files->push_back({"ten_million.stl", many_stl, "announces 10000000 facets, but ends after 0"});
  files->push_back({"flat_corners.obj", "v 0 0 0\nv 1 1 1\nv 2 2 2\nf 1 2 3\n", "no triangle has an area"});
  files->push_back({"index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", ":4"});
  files->push_back({"cut.ply", ply.substr(0, ply.size() / 2), "cut.ply"});
  files->push_back({"cut_binary.ply", binary_ply.substr(0, binary_ply.size() / 2), "cut_binary.ply"});
  files->push_back({"cut.stl", stl.substr(0, stl.size() / 2), "cut.stl"});
  files->push_back({"cut_binary.stl", binary_stl.substr(0, binary_stl.size() / 2), "ends after"});
  files->push_back({"what.xyz", "0 0 0\n", "'.xyz' is not a surface mesh"});
}

void addRepaired(std::vector<BrokenFile>* files) {
  const TriangleMesh torus = smallTorus();
  Triangles doubled(2 * torus.triangles.rows(), 3);
  doubled << torus.triangles, torus.triangles;
  files->push_back({"unwelded.obj", asObj(unwelded()), ""});
  files->push_back({"unwelded.stl", asStl(torus, true), ""});
  files->push_back({"inside_out.ply", asPly(turned(torus, 1), true), ""});
  files->push_back({"flipped.off", asOff(turned(torus, 3)), ""});
  files->push_back(
      {"holes.obj", asObj(withTriangles(torus.triangles.bottomRows(torus.triangles.rows() - 9))), ""});
  files->push_back({"duplicate_faces.obj", asObj(withTriangles(doubled)), ""});
  files->push_back({"intersecting.obj", asObj(both(torus, smallTorus(0.05))), ""});
  files->push_back({"fin.obj", asObj(withFin()), ""});
}

}  // namespace

std::vector<BrokenFile> brokenFiles() {
  std::vector<BrokenFile> files;
  addRefused(&files);
  addRepaired(&files);
  return files;
}

std::vector<BrokenFile> soundFiles() {
  const TriangleMesh torus = smallTorus();
  return {{"a.obj", asObj(torus), ""},        {"a.off", asOff(torus), ""},
          {"a.ply", asPly(torus, false), ""}, {"b.ply", asPly(torus, true), ""},
          {"a.stl", asStl(torus, false), ""}, {"b.stl", asStl(torus, true), ""}};
}

std::string mutated(std::string bytes, std::mt19937* random) {
  const std::string numbers[] = {"-1",    "0",   "4294967295",           "2147483647",
                                 "1e308", "nan", "99999999999999999999", ""};
  const int mutations = 1 + static_cast<int>((*random)() % 4);
  for (int m = 0; m < mutations && !bytes.empty(); ++m) {
    // Headers are short; they get half of the mutations.
    const std::size_t reach = (*random)() % 2 == 0 ? std::min<std::size_t>(bytes.size(), 200) : bytes.size();
    const std::size_t at = (*random)() % reach;
    const std::size_t length = std::min<std::size_t>(1 + (*random)() % 16, bytes.size() - at);
    switch ((*random)() % 5) {
      case 0:
        bytes[at] = static_cast<char>((*random)());
        break;
      case 1:
        bytes.erase(at, length);
        break;
      case 2:
        bytes.insert(at, bytes.substr(at, length));
        break;
      case 3:
        bytes.resize(at);
        break;
      default: {
        const std::size_t begin = bytes.find_first_of("0123456789", at);
        if (begin == std::string::npos) break;
        const std::size_t end = std::min(bytes.find_first_not_of("0123456789.", begin), bytes.size());
        bytes.replace(begin, end - begin, numbers[(*random)() % 8]);
      }
    }
  }
  return bytes;
}

std::string readOrRefuse(const std::string& path) {
  try {
    Warnings warnings;
    loadSurface(path, 1.0, &warnings);
  } catch (const std::invalid_argument& refusal) {
    const std::string said = refusal.what();
    if (said.find(path) != 0 || said.size() < path.size() + 5)
      throw std::runtime_error("no sentence: " + said);
    return said;
  } catch (const std::exception& other) {
    throw std::runtime_error(fmt::format("{}: not a refusal: {}", path, other.what()));
  }
  return "";
}

}  // namespace softbody::test
