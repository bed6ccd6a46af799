#pragma once

#include <memory>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// A place on a triangle mesh.
struct SurfacePoint {
  int triangle = -1;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
};

/// Closest points on a triangle mesh, by an AABB tree (CGAL).
class ClosestPointQuery {
 public:
  ClosestPointQuery(const Points& vertices, const Triangles& triangles);
  ~ClosestPointQuery();

  SurfacePoint closest(const Eigen::Vector3d& point) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace softbody
