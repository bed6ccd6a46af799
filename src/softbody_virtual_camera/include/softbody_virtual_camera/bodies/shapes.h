#pragma once

#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody::virtual_camera {

/// A rectangle from a corner and two edges [m]; its front is edge_u x edge_v.
TriangleMesh rectangle(const Eigen::Vector3d& corner, const Eigen::Vector3d& edge_u,
                       const Eigen::Vector3d& edge_v);

/// A closed cylinder from a to b with hemispheres at its ends; the first half of the vertices is at a.
TriangleMesh capsule(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double radius_m);
/// The same with two radii.
TriangleMesh capsule(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double radius_a_m,
                     double radius_b_m);

/// A closed box around the origin, with the edge lengths `size` [m].
TriangleMesh box(const Eigen::Vector3d& size);

/// A closed cylinder along z with flat ends, around the origin.
TriangleMesh cylinder(double radius_m, double length_m);

/// A closed ball around the origin.
TriangleMesh ball(double radius_m);

/// All meshes in one, with vertices and triangles in their order.
TriangleMesh merge(const std::vector<TriangleMesh>& meshes);

/// A right hand of overlapping capsules, palm down. The fingers point along +x and end near the origin; the
/// forearm ends at x = -0.45. The hand is 100 mm wide along y.
TriangleMesh hand();

/// The points (rows), transformed by T.
Points transformed(const Eigen::Isometry3d& T, const Points& points);

}  // namespace softbody::virtual_camera
