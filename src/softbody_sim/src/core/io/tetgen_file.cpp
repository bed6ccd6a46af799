#include "io/tetgen_file.h"

#include <fmt/format.h>

#include <filesystem>

#include "io/numbered_vertices.h"

namespace softbody {

TetMesh readTetGen(const std::string& path, Warnings* warnings) {
  const std::filesystem::path base(path);
  NumberedVertices mesh;
  TextReader nodes(std::filesystem::path(base).replace_extension(".node").string());
  nodes.require("the number of vertices");
  if (nodes.fields().size() > 1 && nodes.integer(1) != 3)
    nodes.fail("the vertices must be three-dimensional");
  mesh.readVertices(nodes, nodes.count(0));

  TextReader elements(std::filesystem::path(base).replace_extension(".ele").string());
  elements.require("the number of tets");
  const int count = elements.count(0), corners = elements.fields().size() > 1 ? elements.integer(1) : 4;
  if (corners != 4 && corners != 10)
    elements.fail(fmt::format("tets of {} vertices; only 4 and 10 are supported", corners));
  for (int t = 0; t < count; ++t) {
    elements.require(fmt::format("tet {} of {}", t + 1, count));
    mesh.addTet(elements, 1, corners);
  }
  return mesh.mesh(path, warnings);
}

TetMesh readTet(const std::string& path, Warnings* warnings) {
  TextReader reader(path);
  reader.require("the number of vertices");
  const std::size_t first = reader.keyword() == "tet" ? 1 : 0;
  const int vertex_count = reader.count(first);
  const bool is_one_line = reader.fields().size() > 2;  // else "N vertices" and "M tets"
  if (!is_one_line) reader.require("the number of tets");
  const int tet_count = reader.count(is_one_line ? first + 1 : 0);
  NumberedVertices mesh;
  for (int v = 0; v < vertex_count; ++v) {
    reader.require(fmt::format("vertex {} of {}", v + 1, vertex_count));
    mesh.addVertex(reader, v, 0);
  }
  for (int t = 0; t < tet_count; ++t) {
    reader.require(fmt::format("tet {} of {}", t + 1, tet_count));
    const bool has_count = reader.fields().size() > 4;  // of vertices, before them
    if (has_count && reader.integer(0) != 4)
      reader.fail(fmt::format("a cell of {} vertices; only tets are supported", reader.integer(0)));
    mesh.addTet(reader, has_count ? 1 : 0);
  }
  return mesh.mesh(path, warnings);
}

}  // namespace softbody
