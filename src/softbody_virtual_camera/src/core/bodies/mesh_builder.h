#pragma once

#include <vector>

#include "softbody_common/types.h"

namespace softbody::virtual_camera {

/// A corner of a new triangle and its barycentric weights in the triangle that it is a part of.
struct PartCorner {
  int vertex = 0;
  Eigen::RowVector3d weights = Eigen::RowVector3d::Zero();
};

/// Puts a topology together whose triangles are parts of an earlier one's, or fill a cut.
class MeshBuilder {
 public:
  /// Begins with the vertices as they were and no triangles.
  explicit MeshBuilder(const MeshTopology& before);

  int addVertex(const Eigen::RowVector3d& place);
  const Eigen::RowVector3d& place(int vertex) const { return vertices_[static_cast<std::size_t>(vertex)]; }
  /// @param parent triangle before; -1: it fills a cut.
  void addTriangle(const PartCorner& a, const PartCorner& b, const PartCorner& c, int parent);

  /// Of the next revision.
  MeshTopology topology() const;
  const std::vector<int>& triangleParents() const { return triangle_parents_; }

 private:
  const MeshTopology& before_;
  std::vector<Eigen::RowVector3d> vertices_;
  std::vector<PartCorner> corners_;  ///< three a triangle
  std::vector<int> triangle_parents_;
};

}  // namespace softbody::virtual_camera
