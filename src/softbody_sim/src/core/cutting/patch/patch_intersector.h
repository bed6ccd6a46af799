#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// A crossing of a segment and a triangle.
struct PatchHit {
  double t = 0.0;  ///< fraction of the way from the segment's first end, 0..1
  int triangle = -1;
  bool along_normal = false;  ///< the segment passes from the triangle's back to its front
};

/// Crossings of segments with the triangles of a mesh, with a bounding-volume hierarchy. The test (Moeller
/// and Trumbore 1997) compares signs of scalar triple products. Both triangles at an edge compute the same
/// product, so a segment never passes between two neighbours and never hits both.
class PatchIntersector {
 public:
  explicit PatchIntersector(TriangleMesh mesh);

  /// All crossings of the segment a-b, in ascending t. The segment b-a gives the same crossings with 1 - t
  /// and the opposite direction.
  std::vector<PatchHit> hits(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const;

  /// Whether the ends of the segment are on different sides: the number of crossings is odd.
  bool separates(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const;

  /// Triangles whose bounding box meets the given one.
  std::vector<int> trianglesNear(const Eigen::AlignedBox3d& box) const;

  const TriangleMesh& mesh() const { return mesh_; }

 private:
  struct Node {
    Eigen::AlignedBox3d box;
    int first = 0;  ///< leaf: its first entry of order_; otherwise its second child (the first follows it)
    int count = 0;  ///< of the leaf's triangles; 0: not a leaf
  };

  void build(int first, int count);
  template <class Overlaps, class Visit>
  void visit(const Overlaps& overlaps, const Visit& visit_triangle) const;

  TriangleMesh mesh_;
  std::vector<Eigen::AlignedBox3d> boxes_;  ///< per triangle
  std::vector<int> order_;                  ///< triangles, leaf by leaf
  std::vector<Node> nodes_;                 ///< root first, depth first
};

}  // namespace softbody
