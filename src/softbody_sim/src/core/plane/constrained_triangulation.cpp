#include "plane/constrained_triangulation.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

namespace softbody {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;
using FaceBase =
    CGAL::Triangulation_face_base_with_info_2<int, Kernel,
                                              CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure,
                                               CGAL::No_constraint_intersection_requiring_constructions_tag>;

bool insertConstraints(const std::vector<Triangulation::Vertex_handle>& handles,
                       const std::vector<std::array<int, 2>>& constraints, Triangulation* triangulation) {
  try {
    for (const auto& [start, end] : constraints) {
      if (handles[start] == handles[end]) return false;
      triangulation->insert_constraint(handles[start], handles[end]);
    }
  } catch (const Triangulation::Intersection_of_constraints_exception&) {
    return false;
  }
  for (const auto& [start, end] : constraints) {
    if (!triangulation->is_edge(handles[start], handles[end])) return false;  // split by a point within it
  }
  return true;
}

/// Numbers the faces that are connected without crossing a constraint.
void numberRegion(Triangulation::Face_handle first, int region, Triangulation* triangulation) {
  std::vector<Triangulation::Face_handle> open{first};
  first->info() = region;
  while (!open.empty()) {
    const Triangulation::Face_handle face = open.back();
    open.pop_back();
    for (int k = 0; k < 3; ++k) {
      const Triangulation::Face_handle neighbour = face->neighbor(k);
      if (face->is_constrained(k) || triangulation->is_infinite(neighbour) || neighbour->info() >= 0)
        continue;
      neighbour->info() = region;
      open.push_back(neighbour);
    }
  }
}

}  // namespace

std::optional<PlanarTriangulation> triangulatePlane(const std::vector<Eigen::Vector2d>& points,
                                                    const std::vector<std::array<int, 2>>& constraints) {
  Triangulation triangulation;
  std::vector<Triangulation::Vertex_handle> handles;
  handles.reserve(points.size());
  for (std::size_t p = 0; p < points.size(); ++p) {
    handles.push_back(triangulation.insert({points[p].x(), points[p].y()}));
    handles.back()->info() = static_cast<int>(p);
  }
  if (triangulation.dimension() < 2 || !insertConstraints(handles, constraints, &triangulation))
    return std::nullopt;
  for (const auto face : triangulation.finite_face_handles()) face->info() = -1;
  PlanarTriangulation result;
  int regions = 0;
  for (const auto face : triangulation.finite_face_handles()) {
    if (face->info() < 0) numberRegion(face, regions++, &triangulation);
    result.triangles.push_back({face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
    result.regions.push_back(face->info());
  }
  return result;
}

}  // namespace softbody
