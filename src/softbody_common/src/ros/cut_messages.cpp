#include "softbody_common/ros/cut_messages.h"

#include <fmt/format.h>

#include <stdexcept>

#include "softbody_common/ros/conversions.h"

namespace softbody {

softbody_msgs::Cut toMessage(const Cut& cut) {
  MeshTopology patch;
  patch.rest_vertices = cut.patch.vertices;
  patch.triangles = cut.patch.triangles;
  softbody_msgs::MeshTopology arrays = toMessage(patch);
  softbody_msgs::Cut message;
  message.revision = cut.revision;
  message.stroke = cut.stroke;
  message.kind = static_cast<std::uint8_t>(cut.kind);
  message.patch_vertices = std::move(arrays.rest_vertices);
  message.patch_triangles = std::move(arrays.triangles);
  return message;
}

Cut fromMessage(const softbody_msgs::Cut& message) {
  if (message.kind > softbody_msgs::Cut::RESET)
    throw std::invalid_argument(fmt::format("kind is {}; allowed: 0 to 3", message.kind));
  Cut cut;
  cut.revision = message.revision;
  cut.stroke = message.stroke;
  cut.kind = static_cast<CutKind>(message.kind);
  cut.patch.vertices.resize(static_cast<Eigen::Index>(message.patch_vertices.size()), 3);
  for (Eigen::Index v = 0; v < cut.patch.vertices.rows(); ++v) {
    const geometry_msgs::Point32& p = message.patch_vertices[static_cast<std::size_t>(v)];
    cut.patch.vertices.row(v) << p.x, p.y, p.z;
    if (!cut.patch.vertices.row(v).allFinite())
      throw std::invalid_argument(fmt::format("patch_vertices[{}] is not finite", v));
  }
  cut.patch.triangles.resize(static_cast<Eigen::Index>(message.patch_triangles.size()), 3);
  for (Eigen::Index f = 0; f < cut.patch.triangles.rows(); ++f) {
    for (Eigen::Index k = 0; k < 3; ++k) {
      const std::uint32_t v =
          message.patch_triangles[static_cast<std::size_t>(f)].vertex_indices[static_cast<std::size_t>(k)];
      if (v >= message.patch_vertices.size()) {
        throw std::invalid_argument(
            fmt::format("patch_triangles[{}] names vertex {} of {}", f, v, message.patch_vertices.size()));
      }
      cut.patch.triangles(f, k) = static_cast<int>(v);
    }
  }
  return cut;
}

}  // namespace softbody
