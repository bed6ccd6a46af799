#include "softbody_sim/object/visual_mesh.h"

#include <fmt/format.h>

#include "shells/body_choice.h"
#include "shells/simplification.h"
#include "shells/surface_transfer.h"
#include "softbody_common/geometry/tet_geometry.h"
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

WeldedSurface simplifiedTo(int triangles, const WeldedSurface& surface, const std::string& name,
                           Warnings* warnings) {
  if (triangles == 0 || surface.mesh.triangles.rows() <= triangles) return surface;
  WeldedSurface result = transferred(surface, simplified(surface.mesh, triangles));
  warnings->push_back(fmt::format("{}: simplified from {} to {} triangles{}", name,
                                  surface.mesh.triangles.rows(), result.mesh.triangles.rows(),
                                  surface.texture_coordinates.rows() > 0
                                      ? "; the texture is stretched in triangles across its seams"
                                      : ""));
  return result;
}

/// Given tets or a given cage say what the body is. Then no part of the mesh is left out.
WeldedSurface loadBody(const ObjectDescription& description, Warnings* warnings) {
  const std::string& name = description.visual_mesh;
  const BodyOptions& body = description.body;
  const bool is_sheet = body.thickness > 0.0;
  WeldedSurface surface =
      loadSurface(name, 1.0, warnings, is_sheet ? SurfaceKind::kSheet : SurfaceKind::kSolid);
  if (is_sheet) surface = thickened(surface, body.thickness, name);
  if (!description.tet_mesh.empty() || !description.cage_mesh.empty())
    return wholeBody(std::move(surface), description.unit_m, name, warnings);
  surface = chosenBody(std::move(surface), {body.shell, description.unit_m, body.length_m}, name, warnings);
  return simplifiedTo(body.triangles, surface, name, warnings);
}

}  // namespace

MeshTopology loadVisualMesh(const ObjectDescription& description, Warnings* warnings) {
  WeldedSurface surface = loadBody(description, warnings);
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
