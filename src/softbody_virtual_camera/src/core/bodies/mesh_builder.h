#pragma once

#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody::virtual_camera {

/// A corner of a new triangle, and its barycentric weights in the old triangle.
struct PartCorner {
  int vertex = 0;
  Eigen::RowVector3d weights = Eigen::RowVector3d::Zero();
};

/// Builds a topology from parts of the triangles of an earlier topology, and triangles that fill a cut.
class MeshBuilder {
 public:
  /// Starts with the earlier vertices and without triangles.
  explicit MeshBuilder(const MeshTopology& before);

  int addVertex(const Eigen::RowVector3d& place);
  const Eigen::RowVector3d& place(int vertex) const { return vertices_[static_cast<std::size_t>(vertex)]; }
  /// @param parent index of the old triangle; -1: it fills a cut.
  void addTriangle(const PartCorner& a, const PartCorner& b, const PartCorner& c, int parent);

  /// The topology of the next revision.
  MeshTopology topology() const;
  const std::vector<int>& triangleParents() const { return triangle_parents_; }

 private:
  const MeshTopology& before_;
  std::vector<Eigen::RowVector3d> vertices_;
  std::vector<PartCorner> corners_;  ///< three per triangle
  std::vector<int> triangle_parents_;
};

}  // namespace softbody::virtual_camera
