#include "io/off_file.h"

#include <fmt/format.h>

#include <vector>

#include "io/stack_rows.h"
#include "io/text_reader.h"

namespace softbody {
namespace {

void addFan(const TextReader& reader, int vertex_count, std::vector<Eigen::RowVector3i>* triangles) {
  const int corners = reader.integer(0);
  if (corners < 3) reader.fail(fmt::format("a face of {} corners", corners));
  for (int k = 1; k <= corners; ++k) {
    const int vertex = reader.integer(static_cast<std::size_t>(k));
    if (vertex < 0 || vertex >= vertex_count) {
      reader.fail(fmt::format("a face refers to vertex {}; the file has 0 to {}", vertex, vertex_count - 1));
    }
  }
  for (int k = 3; k <= corners; ++k) {
    const auto corner = [&reader](int i) { return reader.integer(static_cast<std::size_t>(i)); };
    triangles->emplace_back(corner(1), corner(k - 1), corner(k));
  }
}

}  // namespace

SurfaceFile readOff(const std::string& path) {
  TextReader reader(path);
  reader.require("the word OFF");
  if (reader.keyword() != "OFF") reader.fail(fmt::format("'{}' instead of OFF", reader.keyword()));
  // The counts may follow the keyword on its line.
  const std::size_t first = reader.fields().size() > 1 ? 1 : 0;
  if (first == 0) reader.require("the counts of vertices and faces");
  const int vertex_count = reader.count(first);
  const int face_count = reader.count(first + 1);
  std::vector<Eigen::RowVector3d> vertices;
  for (int v = 0; v < vertex_count; ++v) {
    reader.require(fmt::format("vertex {} of {}", v + 1, vertex_count));
    vertices.push_back(reader.point(0));
  }
  std::vector<Eigen::RowVector3i> triangles;
  for (int f = 0; f < face_count; ++f) {
    reader.require(fmt::format("face {} of {}", f + 1, face_count));
    addFan(reader, vertex_count, &triangles);
  }
  return {{stackRows<Points>(vertices), stackRows<Triangles>(triangles)}, {}};
}

}  // namespace softbody
