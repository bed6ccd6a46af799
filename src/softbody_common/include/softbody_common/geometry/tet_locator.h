#pragma once

#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// Finds the tet that contains a point, or the nearest tet, with a uniform grid over the tets' bounding
/// boxes.
class TetLocator {
 public:
  /// @throw std::invalid_argument if there is no tet, an index is out of range or a tet has no volume.
  TetLocator(const Points& vertices, const Tets& tets);

  /// The tet that contains the point, with barycentric coordinates. For a point outside of the mesh: the
  /// nearest tet, with extrapolated coordinates that reproduce the point. If several tets are equally near,
  /// the one with the lowest index is used.
  /// @throw std::invalid_argument if the point is not finite.
  MaterialPoint locate(const Eigen::Vector3d& point) const;

  /// Whether the point is in a tet; also fast for points outside.
  bool contains(const Eigen::Vector3d& point) const;

 private:
  struct Candidate {
    int tet;
    double squared_distance;
    Eigen::Vector4d barycentric;
  };
  Eigen::Vector3i cellOf(const Eigen::Vector3d& point) const;
  const std::vector<int>& tetsIn(const Eigen::Vector3i& cell) const;
  Eigen::Vector4d barycentricIn(int tet, const Eigen::Vector3d& point) const;
  double squaredDistanceToPlanes(int tet, const Eigen::Vector4d& barycentric) const;
  void considerRing(const Eigen::Vector3d& point, const Eigen::Vector3i& center, int ring,
                    Candidate* best) const;
  void consider(const Eigen::Vector3d& point, int tet, Candidate* best) const;

  Points vertices_;
  Tets tets_;
  std::vector<Eigen::Matrix3d> inverse_edges_;
  Eigen::Vector3d origin_;
  Eigen::Vector3i cells_;
  double cell_size_ = 0.0;
  std::vector<std::vector<int>> grid_;
};

/// The material point of each point.
std::vector<MaterialPoint> bindPoints(const Points& points, const Points& vertices, const Tets& tets);

/// Positions of material points for the given tet vertices, #places by 3 [m].
Points applyBinding(const std::vector<MaterialPoint>& places, const Points& vertices, const Tets& tets);

}  // namespace softbody
