#pragma once

#include <string>
#include <vector>

#include "softbody_sim/io/surface_files.h"

namespace softbody {

/// A triangle mesh without coincident vertices, and the index of each vertex in the file.
struct WeldedSurface {
  TriangleMesh mesh;
  Points texture_coordinates;       ///< empty, or 3 #F rows
  std::vector<int> vertex_parents;  ///< #V: index in the file of the first vertex at that place
};

/// Edges that keep a surface from being closed.
struct EdgeReport {
  int open = 0;          ///< edges with one triangle
  int branching = 0;     ///< edges with more than two triangles
  int inconsistent = 0;  ///< edges with the same direction in both triangles
  Eigen::Vector2i example = Eigen::Vector2i::Constant(-1);  ///< one of the open or branching edges

  bool closed() const { return open == 0 && branching == 0; }
};

EdgeReport examineEdges(const Triangles& triangles);

/// Keeps these triangles, in this order, and drops the vertices that no triangle uses any more.
void keepTriangles(const std::vector<Eigen::Index>& kept, WeldedSurface* surface);

/// Turns triangles over, with their texture. @param flip #F. @return how many.
std::ptrdiff_t flipTriangles(const std::vector<bool>& flip, WeldedSurface* surface);

/// What a mesh is meant to be. The triangles of a sheet have no separate back.
enum class SurfaceKind { kSolid, kSheet };

/// Drops unused vertices, welds vertices within 1e-7 of the mesh's size (up to 1e-4 if that closes it), drops
/// flat and repeated triangles, and makes neighbours face the same way. Vertices stay in file order.
/// @param name of the mesh, for warnings. @throw std::invalid_argument if no triangle is left.
WeldedSurface repairSurface(const SurfaceFile& file, const std::string& name, Warnings* warnings,
                            SurfaceKind kind = SurfaceKind::kSolid);

/// Reads a surface, scales it to metres and repairs it.
WeldedSurface loadSurface(const std::string& path, double unit_m, Warnings* warnings,
                          SurfaceKind kind = SurfaceKind::kSolid);

/// Length of the bounding box's diagonal.
double sizeOf(const Points& vertices);

}  // namespace softbody
