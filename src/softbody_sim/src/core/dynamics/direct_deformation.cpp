#include "dynamics/direct_deformation.h"

#include "softbody_common/geometry/tet_geometry.h"

namespace softbody {

void moveToTargets(const std::vector<Target>& targets, const TetTopology& topology, Points* vertices) {
  std::vector<bool> on_surface(static_cast<std::size_t>(vertices->rows()), false);
  for (int vertex : topology.surface.reshaped()) on_surface[static_cast<std::size_t>(vertex)] = true;

  Points moves = Points::Zero(vertices->rows(), 3);
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(vertices->rows());
  for (const Target& target : targets) {
    Eigen::Vector3d offset = target.position - positionOf(target.place, *vertices, topology.tets);
    const Eigen::Vector3d normal = target.normal.normalized();
    if (!normal.isZero(0.0)) offset = normal.dot(offset) * normal;
    for (int k = 0; k < 4; ++k) {
      const int vertex = topology.tets(target.place.tet, k);
      const double weight = target.weight * target.place.barycentric[k];
      if (!on_surface[static_cast<std::size_t>(vertex)] || weight <= 0.0) continue;
      moves.row(vertex) += weight * offset.transpose();
      weights[vertex] += weight;
    }
  }
  for (Eigen::Index v = 0; v < vertices->rows(); ++v) {
    if (weights[v] > 0.0) vertices->row(v) += moves.row(v) / weights[v];
  }
}

}  // namespace softbody
