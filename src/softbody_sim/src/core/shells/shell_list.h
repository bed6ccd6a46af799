#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// A connected surface of a mesh. Surfaces that only touch in edges or vertices are separate shells.
struct Shell {
  std::vector<Eigen::Index> triangles;
  Eigen::AlignedBox3d box;
  double area = 0.0;
  double volume = 0.0;  ///< signed; of an open shell, about the mean of its corners

  /// A plane, a lone triangle or another surface that encloses nothing: its mean thickness is below a
  /// thousandth of its size.
  bool isSheet() const;
};

/// The shells of a mesh whose neighbours face the same way, in the order of their first triangles.
std::vector<Shell> shellsOf(const TriangleMesh& mesh);

/// Per shell, the closed shells around it. The shells must not cross each other.
std::vector<std::vector<std::size_t>> containersOf(const TriangleMesh& mesh,
                                                   const std::vector<Shell>& shells);

/// Per shell, whether an earlier one covers the same space: the back of a two-sided surface, or a copy.
std::vector<bool> repeatedShells(const std::vector<Shell>& shells);

}  // namespace softbody
