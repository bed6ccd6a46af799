#include "bodies/mesh_builder.h"

#include "softbody_common/geometry/tet_geometry.h"

namespace softbody::virtual_camera {

MeshBuilder::MeshBuilder(const MeshTopology& before) : before_(before) {
  for (Eigen::Index i = 0; i < before.rest_vertices.rows(); ++i)
    vertices_.push_back(before.rest_vertices.row(i));
}

int MeshBuilder::addVertex(const Eigen::RowVector3d& place) {
  vertices_.push_back(place);
  return static_cast<int>(vertices_.size()) - 1;
}

void MeshBuilder::addTriangle(const PartCorner& a, const PartCorner& b, const PartCorner& c, int parent) {
  corners_.insert(corners_.end(), {a, b, c});
  triangle_parents_.push_back(parent);
}

MeshTopology MeshBuilder::topology() const {
  MeshTopology topology;
  topology.revision = before_.revision + 1;
  topology.rest_vertices.resize(static_cast<Eigen::Index>(vertices_.size()), 3);
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    topology.rest_vertices.row(static_cast<Eigen::Index>(i)) = vertices_[i];
  }
  const bool textured = before_.texture_coordinates.rows() > 0;
  topology.triangles.resize(static_cast<Eigen::Index>(triangle_parents_.size()), 3);
  topology.texture_coordinates.setZero(textured ? static_cast<Eigen::Index>(corners_.size()) : 0, 3);
  for (std::size_t c = 0; c < corners_.size(); ++c) {
    const Eigen::Index parent = triangle_parents_[c / 3];
    topology.triangles(static_cast<Eigen::Index>(c / 3), static_cast<Eigen::Index>(c % 3)) =
        corners_[c].vertex;
    if (!textured || parent < 0) continue;
    topology.texture_coordinates.row(static_cast<Eigen::Index>(c)) =
        corners_[c].weights * before_.texture_coordinates.middleRows<3>(3 * parent);
  }
  for (const int parent : triangle_parents_) {
    topology.cut.push_back(parent < 0 || before_.cut[static_cast<std::size_t>(parent)]);
  }
  topology.vertex_parents = before_.vertex_parents;
  topology.vertex_parents.resize(vertices_.size(), -1);
  topology.triangle_pieces = trianglePieces(topology.triangles, static_cast<int>(vertices_.size()));
  return topology;
}

}  // namespace softbody::virtual_camera
