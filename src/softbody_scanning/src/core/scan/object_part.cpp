#include "scan/object_part.h"

#include "softbody_common/tet_geometry.h"
#include "softbody_scanning/surface/mesh_parts.h"

namespace softbody::scanning {

Eigen::AlignedBox3d boxOf(const TriangleMesh& mesh) {
  return {mesh.vertices.colwise().minCoeff().transpose(), mesh.vertices.colwise().maxCoeff().transpose()};
}

std::optional<TriangleMesh> objectPart(const TriangleMesh& mesh) {
  std::optional<TriangleMesh> object;
  double best = 0.0;
  for (TriangleMesh& part : partsOf(mesh)) {
    const double size = std::cbrt(enclosedVolume(part.vertices, part.triangles));
    const double aside = boxOf(part).center().head<2>().norm();
    if (!(size > 0.0) || size / (size + aside) * size <= best) continue;
    best = size / (size + aside) * size;
    object = std::move(part);
  }
  return object;
}

}  // namespace softbody::scanning
