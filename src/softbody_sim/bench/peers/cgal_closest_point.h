#pragma once

#include <memory>

#include "softbody_common/geometry/types.h"

namespace softbody::bench {

/// Closest points on a triangle mesh by CGAL's AABB tree over the faces of its Surface_mesh.
class CgalClosestPoint {
 public:
  explicit CgalClosestPoint(const TriangleMesh& mesh);
  ~CgalClosestPoint();

  Eigen::Vector3d closest(const Eigen::Vector3d& point) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace softbody::bench
