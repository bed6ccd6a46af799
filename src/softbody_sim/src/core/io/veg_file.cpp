#include "io/veg_file.h"

#include <fmt/format.h>

#include "io/numbered_vertices.h"

namespace softbody {
namespace {

void readVertices(TextReader& reader, NumberedVertices* mesh) {
  reader.require("the number of vertices");
  mesh->readVertices(reader, reader.count(0));
}

void readTets(TextReader& reader, NumberedVertices* mesh) {
  reader.require("the kind of elements");
  if (reader.keyword() != "tet" && reader.keyword() != "tets") {
    reader.fail(fmt::format("elements of kind {}; only TET is supported", reader.fields().front()));
  }
  reader.require("the number of elements");
  const int count = reader.count(0);
  for (int e = 0; e < count; ++e) {
    reader.require(fmt::format("tet {} of {}", e + 1, count));
    mesh->addTet(reader, 1);
  }
}

}  // namespace

TetMesh readVeg(const std::string& path, Warnings* warnings) {
  TextReader reader(path);
  NumberedVertices mesh;
  bool has_elements = false, has_material = false;
  while (reader.next()) {
    if (reader.keyword() == "*include")
      reader.fail("*INCLUDE is not supported; put the sections into one file");
    if (reader.keyword() == "*vertices") readVertices(reader, &mesh);
    if (reader.keyword() == "*elements") {
      readTets(reader, &mesh);
      has_elements = true;
    }
    has_material = has_material || reader.keyword() == "*material";
  }
  if (!has_elements) reader.fail("the file ends without an *ELEMENTS section");
  if (has_material) warnings->push_back(path + ": *MATERIAL is ignored; the object YAML gives the material");
  return mesh.mesh(path, warnings);
}

}  // namespace softbody
