#include "estimation/target_residual.h"

#include <Eigen/Dense>

namespace softbody {

Eigen::Vector3d residualOf(const Target& target, const Tets& tets, const Points& vertices) {
  Eigen::Vector3d residual = target.position;
  for (int k = 0; k < 4; ++k)
    residual -= target.place.barycentric[k] * vertices.row(tets(target.place.tet, k)).transpose();
  if (target.normal.isZero()) return residual;
  const Eigen::Vector3d normal = target.normal.normalized();
  return normal.dot(residual) * normal;
}

}  // namespace softbody
