#include "bench/peers/cgal_closest_point.h"

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

namespace softbody::bench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Primitive = CGAL::AABB_face_graph_triangle_primitive<Mesh>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Mesh meshOf(const TriangleMesh& from) {
  Mesh mesh;
  for (const auto& p : from.vertices.rowwise()) mesh.add_vertex({p.x(), p.y(), p.z()});
  for (const auto& f : from.triangles.rowwise())
    mesh.add_face(Mesh::Vertex_index(f[0]), Mesh::Vertex_index(f[1]), Mesh::Vertex_index(f[2]));
  return mesh;
}

}  // namespace

struct CgalClosestPoint::Implementation {
  explicit Implementation(const TriangleMesh& from)
      : mesh(meshOf(from)), tree(faces(mesh).first, faces(mesh).second, mesh) {
    tree.build();
    tree.accelerate_distance_queries();
  }

  Mesh mesh;
  Tree tree;
};

CgalClosestPoint::CgalClosestPoint(const TriangleMesh& mesh)
    : implementation_(std::make_unique<Implementation>(mesh)) {}

CgalClosestPoint::~CgalClosestPoint() = default;

Eigen::Vector3d CgalClosestPoint::closest(const Eigen::Vector3d& point) const {
  const auto place = implementation_->tree.closest_point({point.x(), point.y(), point.z()});
  return {place.x(), place.y(), place.z()};
}

}  // namespace softbody::bench
