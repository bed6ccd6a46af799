#include "cutting/patch/patch_slab.h"

#include <Eigen/Geometry>
#include <cmath>

namespace softbody {

PatchSlab::PatchSlab(const TriangleMesh& patch) {
  for (Eigen::Index f = 0; f < patch.triangles.rows(); ++f) {
    const Eigen::Vector3d p = patch.vertices.row(patch.triangles(f, 0));
    const Eigen::Vector3d q = patch.vertices.row(patch.triangles(f, 1));
    const Eigen::Vector3d r = patch.vertices.row(patch.triangles(f, 2));
    normal_ += (q - p).cross(r - p);
  }
  const Eigen::VectorXd heights = patch.vertices * normal_;
  if (heights.size() == 0) return;
  low_ = heights.minCoeff();
  high_ = heights.maxCoeff();
  const double margin = 1e-9 * (std::abs(low_) + std::abs(high_));
  low_ -= margin;
  high_ += margin;
}

std::vector<signed char> PatchSlab::sidesOf(const Points& points) const {
  const Eigen::VectorXd heights = points * normal_;
  std::vector<signed char> sides(static_cast<std::size_t>(heights.size()));
  for (std::size_t v = 0; v < sides.size(); ++v) {
    const double height = heights[static_cast<Eigen::Index>(v)];
    sides[v] = static_cast<signed char>(height > high_ ? 1 : height < low_ ? -1 : 0);
  }
  return sides;
}

}  // namespace softbody
