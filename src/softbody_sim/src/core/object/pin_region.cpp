#include "softbody_sim/object/pin_region.h"

namespace softbody {

std::vector<int> verticesIn(const PinRegion& region, const Eigen::Isometry3d& T_box_points,
                            const Points& points) {
  std::vector<int> vertices;
  for (int v = 0; v < points.rows(); ++v) {
    const Eigen::Array3d p = T_box_points * Eigen::Vector3d(points.row(v));
    if ((p >= region.min.array()).all() && (p <= region.max.array()).all()) vertices.push_back(v);
  }
  return vertices;
}

}  // namespace softbody
