#include "softbody_common/ros/cut_messages.h"

#include <fmt/format.h>

#include <boost/make_shared.hpp>
#include <stdexcept>
#include <utility>

#include "softbody_common/geometry/tet_topology_check.h"
#include "softbody_common/ros/conversions.h"

namespace softbody {
namespace {

void requirePatchSize(const softbody_msgs::Cut& message) {
  const std::size_t vertices = message.patch_vertices.size(), triangles = message.patch_triangles.size();
  if (message.kind != softbody_msgs::Cut::CUT) {
    if (vertices + triangles > 0) throw std::invalid_argument("an edit of this kind has no patch");
    return;
  }
  if (triangles == 0) throw std::invalid_argument("patch_triangles is empty; a cut needs a patch");
  if (triangles > kMostPatchTriangles || vertices > 3 * kMostPatchTriangles) {
    throw std::invalid_argument(
        fmt::format("the patch has {} triangles and {} vertices; allowed: up to {} and {}", triangles,
                    vertices, kMostPatchTriangles, 3 * kMostPatchTriangles));
  }
}

Points verticesOf(const softbody_msgs::Cut& message) {
  Points vertices(static_cast<Eigen::Index>(message.patch_vertices.size()), 3);
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
    const geometry_msgs::Point32& p = message.patch_vertices[static_cast<std::size_t>(v)];
    vertices.row(v) << p.x, p.y, p.z;
    if (!vertices.row(v).allFinite() || vertices.row(v).cwiseAbs().maxCoeff() > kFurthestRestPoint) {
      throw std::invalid_argument(
          fmt::format("patch_vertices[{}] is not finite, or beyond {} m", v, kFurthestRestPoint));
    }
  }
  return vertices;
}

Triangles trianglesOf(const softbody_msgs::Cut& message) {
  Triangles triangles(static_cast<Eigen::Index>(message.patch_triangles.size()), 3);
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    for (Eigen::Index k = 0; k < 3; ++k) {
      const std::uint32_t v =
          message.patch_triangles[static_cast<std::size_t>(f)].vertex_indices[static_cast<std::size_t>(k)];
      if (v >= message.patch_vertices.size()) {
        throw std::invalid_argument(
            fmt::format("patch_triangles[{}] names vertex {} of {}", f, v, message.patch_vertices.size()));
      }
      triangles(f, k) = static_cast<int>(v);
    }
  }
  return triangles;
}

void requireArea(const TriangleMesh& patch) {
  for (const auto& t : patch.triangles.rowwise()) {
    const Eigen::RowVector3d a = patch.vertices.row(t[0]), b = patch.vertices.row(t[1]),
                             c = patch.vertices.row(t[2]);
    if ((b - a).cross(c - a).squaredNorm() > 0.0) return;
  }
  throw std::invalid_argument("all triangles of the patch have no area");
}

/// Adds the cuts of the next stroke. @param first of them; @param size their number.
Stroke strokeFrom(const softbody_msgs::CutHistory& message, std::size_t first, std::size_t size) {
  if (size == 0 || size > message.cuts.size() - first)
    throw std::invalid_argument(fmt::format("stroke_sizes do not add up to {} cuts", message.cuts.size()));
  Stroke stroke{message.cuts[first].stroke, {}};
  std::size_t triangles = 0;
  for (std::size_t c = first; c < first + size; ++c) {
    Cut cut = fromMessage(message.cuts[c]);
    triangles += static_cast<std::size_t>(cut.patch.triangles.rows());
    if (cut.kind != CutKind::kCut || cut.stroke != stroke.number || triangles > kMostPatchTriangles)
      throw std::invalid_argument(
          fmt::format("cuts[{}] is not a cut of its stroke, or makes it too long", c));
    stroke.patches.push_back(std::move(cut.patch));
  }
  return stroke;
}

}  // namespace

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
  requirePatchSize(message);
  Cut cut;
  cut.revision = message.revision;
  cut.stroke = message.stroke;
  cut.kind = static_cast<CutKind>(message.kind);
  cut.patch.vertices = verticesOf(message);
  cut.patch.triangles = trianglesOf(message);
  if (cut.kind == CutKind::kCut) requireArea(cut.patch);
  return cut;
}

softbody_msgs::CutHistory toMessage(const EditHistory& edits, const TetTopology& uncut) {
  softbody_msgs::CutHistory message;
  message.body = edits.body;
  message.revision = edits.revision;
  message.uncut = toMessage(uncut);
  for (const Stroke& stroke : edits.strokes) {
    message.stroke_sizes.push_back(static_cast<std::uint32_t>(stroke.patches.size()));
    for (const TriangleMesh& patch : stroke.patches)
      message.cuts.push_back(toMessage(Cut{0, stroke.number, CutKind::kCut, patch}));
  }
  message.strokes_in_force = static_cast<std::uint32_t>(edits.in_force);
  message.stroke_is_open = static_cast<std::uint8_t>(edits.is_open);
  return message;
}

softbody_msgs::CutHistoryPtr historyMessage(const EditHistory& edits, const TetTopology& uncut,
                                            const std::string& body_frame, const ros::Time& stamp) {
  auto message = boost::make_shared<softbody_msgs::CutHistory>(toMessage(edits, uncut));
  message->header.frame_id = body_frame;
  message->header.stamp = stamp;
  return message;
}

EditedBody fromMessage(const softbody_msgs::CutHistory& message) {
  if (message.cuts.size() > kMostCuts)
    throw std::invalid_argument(
        fmt::format("it has {} cuts; allowed: up to {}", message.cuts.size(), kMostCuts));
  EditedBody body;
  body.uncut = fromMessage(message.uncut);
  body.edits.body = message.body;
  body.edits.revision = message.revision;
  std::size_t cuts = 0;
  for (const std::uint32_t size : message.stroke_sizes) {
    body.edits.strokes.push_back(strokeFrom(message, cuts, size));
    cuts += size;
  }
  if (cuts != message.cuts.size())
    throw std::invalid_argument(fmt::format("stroke_sizes do not add up to {} cuts", message.cuts.size()));
  body.edits.in_force = message.strokes_in_force;
  body.edits.is_open = message.stroke_is_open != 0;
  if (body.edits.in_force > body.edits.strokes.size() || (body.edits.is_open && body.edits.in_force == 0)) {
    throw std::invalid_argument(
        fmt::format("{} of {} strokes are in force", body.edits.in_force, body.edits.strokes.size()));
  }
  return body;
}

}  // namespace softbody
