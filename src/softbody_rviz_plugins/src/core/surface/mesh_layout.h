#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// What the graphics card needs of one vertex in each frame.
struct PlacedVertex {
  Eigen::Vector3f position;  ///< [m]
  Eigen::Vector3f normal;    ///< unit
};

/// The part of a mesh that only a new topology changes. A vertex of the mesh is drawn as several drawn
/// vertices where its triangles need different normals or texture coordinates.
struct MeshLayout {
  std::vector<int> vertices;                      ///< per drawn vertex: the vertex of the mesh
  std::vector<int> normals;                       ///< per drawn vertex: index of its normal
  std::vector<int> triangles;                     ///< per drawn vertex: one of its triangles in the mesh
  std::vector<Eigen::Vector2f> texture;           ///< per drawn vertex, v upwards; or empty
  std::vector<std::vector<std::uint32_t>> parts;  ///< per part: three drawn vertices per triangle
  Triangles corner_normals;                       ///< #F by 3: index of the normal at each corner
  int normal_count = 0;
};

/// Parts: 0 the skin, 1 the faces that fill cuts. Triangles share a normal at a vertex if a chain of edges
/// joins them there, each with an angle below the crease angle in the rest shape, on the same part.
/// @param crease_angle [rad].
MeshLayout layoutOfSurface(const MeshTopology& topology, double crease_angle);

/// Every triangle with a normal of its own, all in one part.
MeshLayout layoutOfFacets(const Triangles& triangles);

/// Positions and smooth normals of the drawn vertices. @param vertices of the mesh [m]. @param triangles of
/// the mesh, from which the layout was made.
std::vector<PlacedVertex> place(const MeshLayout& layout, const Points& vertices, const Triangles& triangles);

}  // namespace softbody
