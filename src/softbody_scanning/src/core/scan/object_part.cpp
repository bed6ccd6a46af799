#include "scan/object_part.h"

#include <fmt/format.h>

#include <limits>
#include <stdexcept>

#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_scanning/surface/mesh_parts.h"

namespace softbody::scanning {
namespace {

/// Distance of the nearest vertex over the part's size, the diagonal of its box.
double relativeDistance(const TriangleMesh& part, const Eigen::Vector3d& at) {
  return (part.vertices.rowwise() - at.transpose()).rowwise().norm().minCoeff() /
         boxOf(part).diagonal().norm();
}

std::optional<TriangleMesh> partAt(const Eigen::Vector3d& at, std::vector<TriangleMesh> parts) {
  // A place in a body is nearer than this to its surface; a click beside it may miss by as much.
  constexpr double kFarthest = 0.5;
  std::optional<TriangleMesh> nearest;
  double least = std::numeric_limits<double>::infinity();
  for (TriangleMesh& part : parts) {
    if (!(enclosedVolume(part.vertices, part.triangles) > 0.0)) continue;
    const double distance = relativeDistance(part, at);
    if (distance >= least) continue;
    least = distance;
    nearest = std::move(part);
  }
  if (nearest && least > kFarthest) {
    const Eigen::Vector3d middle = boxOf(*nearest).center();
    throw std::invalid_argument(
        fmt::format("nothing stands at ({:.3f}, {:.3f}, {:.3f}) m; choose a point of the object: the nearest "
                    "thing on the table "
                    "is at ({:.3f}, {:.3f}, {:.3f}) m",
                    at.x(), at.y(), at.z(), middle.x(), middle.y(), middle.z()));
  }
  return nearest;
}

std::optional<TriangleMesh> partInTheMiddle(std::vector<TriangleMesh> parts) {
  std::optional<TriangleMesh> object;
  double best = 0.0;
  for (TriangleMesh& part : parts) {
    const double size = std::cbrt(enclosedVolume(part.vertices, part.triangles));
    const double aside = boxOf(part).center().head<2>().norm();
    if (!(size > 0.0) || size / (size + aside) * size <= best) continue;
    best = size / (size + aside) * size;
    object = std::move(part);
  }
  return object;
}

}  // namespace

Eigen::AlignedBox3d boxOf(const TriangleMesh& mesh) {
  return {mesh.vertices.colwise().minCoeff().transpose(), mesh.vertices.colwise().maxCoeff().transpose()};
}

std::optional<TriangleMesh> objectPart(const TriangleMesh& mesh, const std::optional<Eigen::Vector3d>& at) {
  return at ? partAt(*at, partsOf(mesh)) : partInTheMiddle(partsOf(mesh));
}

}  // namespace softbody::scanning
