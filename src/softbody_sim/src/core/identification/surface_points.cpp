#include "identification/surface_points.h"

#include <Eigen/Geometry>

#include "softbody_common/geometry/surface_binding.h"
#include "softbody_sim/surface_mesh/closest_point.h"

namespace softbody {
namespace {

Eigen::Matrix3d cornersOf(const Points& vertices, const Triangles& triangles, int triangle) {
  Eigen::Matrix3d corners;
  for (int k = 0; k < 3; ++k) corners.col(k) = vertices.row(triangles(triangle, k)).transpose();
  return corners;
}

}  // namespace

SurfacePoints::SurfacePoints(const MeshTopology& visual, const TetTopology& volume)
    : visual_(visual),
      volume_(&volume),
      locator_(volume.rest_vertices, volume.tets),
      binding_(bindSurface(visual, volume)) {}

std::vector<Target> SurfacePoints::targetsOf(const Points& measured, const Points& vertices) const {
  const Points surface = applyBinding(binding_, vertices, volume_->tets);
  const ClosestPointQuery query(surface, visual_.triangles);
  std::vector<Target> targets;
  for (const auto& row : measured.rowwise()) {
    const Eigen::Vector3d point = row.transpose();
    const SurfacePoint closest = query.closest(point);
    const Eigen::Matrix3d corners = cornersOf(surface, visual_.triangles, closest.triangle);
    const Eigen::Vector3d normal = (corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0));
    if (!(normal.norm() > 0.0)) continue;
    const Eigen::Vector3d rest =
        cornersOf(visual_.rest_vertices, visual_.triangles, closest.triangle) *
        cornerWeights(closest.position, corners.col(0), corners.col(1), corners.col(2));
    Target target;
    target.kind = TargetKind::kDepth;
    target.place = locator_.locate(rest);
    target.position = point;
    target.normal = normal.normalized();
    targets.push_back(target);
  }
  return targets;
}

}  // namespace softbody
