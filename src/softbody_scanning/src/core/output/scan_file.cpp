#include "output/scan_file.h"

#include <fmt/format.h>

namespace softbody::scanning {
namespace {

template <typename Value>
void append(Value value, std::string* bytes) {
  bytes->append(reinterpret_cast<const char*>(&value), sizeof value);
}

}  // namespace

std::string scanPly(const TriangleMesh& mesh, const std::vector<float>& seen) {
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment metres; seen: 1 measured, 0 never seen by the camera\n"
      "element vertex {}\nproperty float x\nproperty float y\nproperty float z\nproperty float seen\n"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      mesh.vertices.rows(), mesh.triangles.rows());
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
    for (int axis = 0; axis < 3; ++axis) append(static_cast<float>(mesh.vertices(v, axis)), &bytes);
    append(seen[v], &bytes);
  }
  for (const auto& triangle : mesh.triangles.rowwise()) {
    append(std::uint8_t{3}, &bytes);
    for (const int vertex : triangle) append(std::int32_t{vertex}, &bytes);
  }
  return bytes;
}

}  // namespace softbody::scanning
