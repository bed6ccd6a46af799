#pragma once

#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_common/geometry/types.h"

namespace softbody {

/// A box of n cells per side on the surface, each with two triangles, edges of 1 m. Closed and outward.
inline MeshTopology boxSurface(int n) {
  std::vector<Eigen::RowVector3d> places;
  std::vector<Eigen::RowVector3i> triangles;
  const auto vertexAt = [&](const Eigen::RowVector3d& place) {
    for (std::size_t v = 0; v < places.size(); ++v) {
      if ((places[v] - place).norm() < 1e-9) return static_cast<int>(v);
    }
    places.push_back(place);
    return static_cast<int>(places.size()) - 1;
  };
  for (int axis = 0; axis < 3; ++axis) {
    for (const int side : {0, 1}) {
      const auto corner = [&](int i, int j) {
        Eigen::RowVector3d place;
        place[axis] = side, place[(axis + 1) % 3] = double(i) / n, place[(axis + 2) % 3] = double(j) / n;
        return vertexAt(place);
      };
      for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
          const int a = corner(i, j), b = corner(i + 1, j), c = corner(i + 1, j + 1), d = corner(i, j + 1);
          if (side == 1) {
            triangles.insert(triangles.end(), {{a, b, c}, {a, c, d}});
          } else {
            triangles.insert(triangles.end(), {{a, c, b}, {a, d, c}});
          }
        }
      }
    }
  }
  MeshTopology topology;
  topology.rest_vertices.resize(static_cast<Eigen::Index>(places.size()), 3);
  for (std::size_t v = 0; v < places.size(); ++v) topology.rest_vertices.row(static_cast<int>(v)) = places[v];
  topology.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    topology.triangles.row(static_cast<int>(t)) = triangles[t];
  topology.vertex_parents.assign(places.size(), 0);
  topology.triangle_pieces.assign(triangles.size(), 0);
  topology.cut.assign(triangles.size(), false);
  return topology;
}

inline MeshState stateAt(const Points& vertices, std::uint32_t revision = 0) {
  return {revision, 0, vertices, std::vector<float>(static_cast<std::size_t>(vertices.rows()), 1.0f)};
}

/// A cube of 1 m as six tets around its diagonal.
inline TetTopology cubeOfTets() {
  TetTopology topology;
  topology.rest_vertices.resize(8, 3);
  for (int v = 0; v < 8; ++v) topology.rest_vertices.row(v) << (v & 1), (v >> 1 & 1), (v >> 2 & 1);
  topology.tets.resize(6, 4);
  topology.tets << 0, 1, 3, 7, 0, 3, 2, 7, 0, 2, 6, 7, 0, 6, 4, 7, 0, 4, 5, 7, 0, 5, 1, 7;
  topology.surface = boundaryTriangles(topology.tets);
  topology.vertex_parents = {0, 1, 2, 3, 4, 5, 6, 7};
  topology.tet_pieces.assign(6, 0);
  return topology;
}

}  // namespace softbody
