#include "io/tetgen_file.h"

#include <fmt/format.h>

#include <filesystem>

#include "io/numbered_vertices.h"

namespace softbody {

TetMesh readTetGen(const std::string& path) {
  const std::filesystem::path base(path);
  NumberedVertices mesh;
  TextReader nodes(std::filesystem::path(base).replace_extension(".node").string());
  nodes.require("the number of vertices");
  if (nodes.fields().size() > 1 && nodes.integer(1) != 3)
    nodes.fail("the vertices must be three-dimensional");
  mesh.readVertices(nodes, nodes.count(0));

  TextReader elements(std::filesystem::path(base).replace_extension(".ele").string());
  elements.require("the number of tets");
  const int count = elements.count(0);
  if (elements.fields().size() > 1 && elements.integer(1) != 4) {
    elements.fail(fmt::format("tets of {} vertices; only 4 are supported", elements.integer(1)));
  }
  for (int t = 0; t < count; ++t) {
    elements.require(fmt::format("tet {} of {}", t + 1, count));
    mesh.addTet(elements, 1);
  }
  return mesh.mesh();
}

}  // namespace softbody
