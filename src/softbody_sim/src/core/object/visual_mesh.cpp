#include "softbody_sim/object/visual_mesh.h"

#include <fmt/format.h>

#include "softbody_common/tet_geometry.h"
#include "surface_mesh/surface_repair.h"
#include "surface_mesh/thickening.h"

namespace softbody {
namespace {

// Outside of this range the unit is probably wrong.
constexpr double kSmallest_m = 0.005;
constexpr double kLargest_m = 10.0;

void warnOfSize(const std::string& name, const Points& vertices, Warnings* warnings) {
  const double size = sizeOf(vertices);
  if (size > kSmallest_m && size < kLargest_m) return;
  warnings->push_back(fmt::format("{}: the size is {:.4g} m; check object/unit", name, size));
}

void warnOfEdges(const std::string& name, const Triangles& triangles, Warnings* warnings) {
  const EdgeReport edges = examineEdges(triangles);
  if (edges.open > 0)
    warnings->push_back(
        fmt::format("{}: not closed, {} edges have one triangle; fill the holes if they are not meant", name,
                    edges.open));
  if (edges.branching > 0) {
    warnings->push_back(
        fmt::format("{}: {} edges have more than two triangles; repair the mesh if this is not meant", name,
                    edges.branching));
  }
  if (edges.inconsistent > 0) {
    warnings->push_back(
        fmt::format("{}: cannot be oriented: {} edges are inconsistent; repair the mesh, so that all "
                    "triangles show outward",
                    name, edges.inconsistent));
  }
}

}  // namespace

MeshTopology loadVisualMesh(const ObjectDescription& description, Warnings* warnings) {
  WeldedSurface surface = loadSurface(description.visual_mesh, description.unit_m, warnings);
  if (description.thickness_m > 0.0)
    surface = thickened(surface, description.thickness_m, description.visual_mesh);
  warnOfSize(description.visual_mesh, surface.mesh.vertices, warnings);
  warnOfEdges(description.visual_mesh, surface.mesh.triangles, warnings);
  MeshTopology topology;
  topology.triangle_pieces =
      trianglePieces(surface.mesh.triangles, static_cast<int>(surface.mesh.vertices.rows()));
  topology.cut.assign(static_cast<std::size_t>(surface.mesh.triangles.rows()), false);
  topology.rest_vertices = std::move(surface.mesh.vertices);
  topology.triangles = std::move(surface.mesh.triangles);
  topology.vertex_parents = std::move(surface.vertex_parents);
  topology.texture_coordinates = std::move(surface.texture_coordinates);
  return topology;
}

}  // namespace softbody
