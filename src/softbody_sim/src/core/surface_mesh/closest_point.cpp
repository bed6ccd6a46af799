#include "softbody_sim/surface_mesh/closest_point.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <vector>

namespace softbody {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using KernelTriangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, KernelTriangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Kernel::Point_3 toPoint(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

}  // namespace

struct ClosestPointQuery::Implementation {
  KernelTriangles triangles;
  Tree tree;
};

ClosestPointQuery::ClosestPointQuery(const Points& vertices, const Triangles& triangles)
    : implementation_(std::make_unique<Implementation>()) {
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    implementation_->triangles.emplace_back(toPoint(vertices.row(triangles(f, 0))),
                                            toPoint(vertices.row(triangles(f, 1))),
                                            toPoint(vertices.row(triangles(f, 2))));
  }
  implementation_->tree.insert(implementation_->triangles.cbegin(), implementation_->triangles.cend());
  implementation_->tree.accelerate_distance_queries();
}

ClosestPointQuery::~ClosestPointQuery() = default;

SurfacePoint ClosestPointQuery::closest(const Eigen::Vector3d& point) const {
  const auto [position, primitive] = implementation_->tree.closest_point_and_primitive(toPoint(point));
  return {static_cast<int>(primitive - implementation_->triangles.cbegin()),
          {position.x(), position.y(), position.z()}};
}

}  // namespace softbody
