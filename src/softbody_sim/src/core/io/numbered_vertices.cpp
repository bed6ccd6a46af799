#include "io/numbered_vertices.h"

#include <fmt/format.h>

#include "softbody_common/files/stack_rows.h"

namespace softbody {

void NumberedVertices::readVertices(TextReader& reader, int count) {
  for (int v = 0; v < count; ++v) {
    reader.require(fmt::format("vertex {} of {}", v + 1, count));
    addVertex(reader, reader.integer(0), 1);
  }
}

void NumberedVertices::addVertex(const TextReader& reader, int id, std::size_t first_field) {
  if (!index_of_id_.emplace(id, static_cast<int>(vertices_.size())).second)
    reader.fail(fmt::format("two vertices have the id {}", id));
  vertices_.push_back(reader.point(first_field));
}

void NumberedVertices::addTet(const TextReader& reader, std::size_t first_field, int nodes) {
  Eigen::RowVector4i tet;
  for (std::size_t k = 0; k < 4; ++k) {
    const int id = reader.integer(first_field + k);
    const auto index = index_of_id_.find(id);
    if (index == index_of_id_.end())
      reader.fail(fmt::format("a tet refers to vertex {}, which does not exist", id));
    tet[static_cast<int>(k)] = index->second;
  }
  tets_.push_back(tet);
  quadratic_ += nodes == 4 ? 0 : 1;
}

TetMesh NumberedVertices::mesh(const std::string& path, Warnings* warnings) const {
  if (quadratic_ > 0)
    warnings->push_back(
        fmt::format("{}: {} tets have 10 nodes; only their corners were taken", path, quadratic_));
  return {stackRows<Points>(vertices_), stackRows<Tets>(tets_)};
}

}  // namespace softbody
