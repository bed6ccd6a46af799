#include "io/msh_file.h"

#include <fmt/format.h>

#include "io/numbered_vertices.h"

namespace softbody {
namespace {

constexpr int kGmshTet = 4;

/// Where an element's vertex ids start. Version 1: "id type physical elementary count ids...", version 2: "id
/// type number-of-tags tags... ids...".
std::size_t firstVertexField(const TextReader& reader, bool version_1) {
  if (version_1) return 5;
  const int tags = reader.integer(2);
  if (tags < 0) reader.fail(fmt::format("{} tags", tags));
  return 3 + static_cast<std::size_t>(tags);
}

/// @return the number of skipped elements, which are not tets.
int readElements(TextReader& reader, bool version_1, NumberedVertices* mesh) {
  const int count = reader.count(0);
  int skipped = 0;
  for (int e = 0; e < count; ++e) {
    reader.require(fmt::format("element {} of {}", e + 1, count));
    if (reader.integer(1) == kGmshTet) {
      mesh->addTet(reader, firstVertexField(reader, version_1));
    } else {
      ++skipped;
    }
  }
  return skipped;
}

void checkFormat(TextReader& reader) {
  reader.require("the format's version");
  const double version = reader.number(0);
  if (!(version >= 1.0 && version < 3.0))
    reader.fail(fmt::format("MSH version {} is not supported; supported: 1 and 2", version));
  if (reader.integer(1) != 0) reader.fail("binary MSH files are not supported; save as ascii");
}

}  // namespace

TetMesh readMsh(const std::string& path, Warnings* warnings) {
  TextReader reader(path);
  NumberedVertices mesh;
  int skipped = 0;
  bool has_vertices = false, has_elements = false;
  while (reader.next()) {
    const std::string section(reader.keyword());
    if (section == "$MeshFormat") checkFormat(reader);
    if (section == "$NOD" || section == "$Nodes") {
      reader.require("the number of vertices");
      mesh.readVertices(reader, reader.count(0));
      has_vertices = true;
    }
    if (section == "$ELM" || section == "$Elements") {
      reader.require("the number of elements");
      skipped += readElements(reader, section == "$ELM", &mesh);
      has_elements = true;
    }
  }
  if (!has_vertices) reader.fail("the file ends without a $Nodes or $NOD section");
  if (!has_elements) reader.fail("the file ends without an $Elements or $ELM section");
  if (skipped > 0)
    warnings->push_back(fmt::format("{}: {} elements other than tets were skipped", path, skipped));
  return mesh.mesh();
}

}  // namespace softbody
