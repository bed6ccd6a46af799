#pragma once

#include "cut_bodies.h"

namespace softbody::testing {

/// The surface of a box as a visual mesh for sponge(): vertices 10 mm apart, a little inside of the tets.
inline MeshTopology visualSponge() {
  const TetTopology box = boxTopology({20, 10, 3}, {0.2, 0.1, 0.03});
  std::vector<int> numbers(static_cast<std::size_t>(box.rest_vertices.rows()), -1);
  MeshTopology mesh;
  mesh.triangles = box.surface;
  int count = 0;
  for (int& v : mesh.triangles.reshaped()) {
    int& number = numbers[static_cast<std::size_t>(v)];
    if (number < 0) {
      number = count++;
      mesh.rest_vertices.conservativeResize(count, Eigen::NoChange);
      mesh.rest_vertices.row(number) = box.rest_vertices.row(v);
      mesh.vertex_parents.push_back(number);
    }
    v = number;
  }
  const Eigen::RowVector3d center(0.1, 0.05, 0.015);
  mesh.rest_vertices = (0.96 * (mesh.rest_vertices.rowwise() - center)).rowwise() + center;
  mesh.rest_vertices = inSinglePrecision(mesh.rest_vertices);
  mesh.bodies.assign(static_cast<std::size_t>(mesh.triangles.rows()), 0);
  mesh.cut.assign(static_cast<std::size_t>(mesh.triangles.rows()), false);
  return mesh;
}

}  // namespace softbody::testing
