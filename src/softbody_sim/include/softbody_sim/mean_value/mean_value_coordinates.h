#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// #P by #C: a row of weights for each point.
using WeightRows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

struct CageMesh;

/// Mean value coordinates of points with respect to a closed triangle mesh (Ju et al. 2005; Kang et al. 2022,
/// eq. 12-14). On vertices, edges and faces they equal the linear interpolation over the triangle. Double
/// precision, vectorised over the points. Finds the edges of the cage once for several sets of points.
class MeanValueCage {
 public:
  /// @param vertices #C by 3 [m]; vertices without a triangle get the weight 0. @param triangles outward.
  /// @throw std::invalid_argument if an index is out of range or the triangles are not closed.
  MeanValueCage(const Points& vertices, const Triangles& triangles);
  ~MeanValueCage();

  Eigen::Index vertexCount() const;

  /// @param points #P by 3 [m], inside, on or outside of the cage, in its frame.
  /// @param weights resized to #P by #C; rows sum to 1. @return #P, the cage's winding number around each
  /// point: 1 inside or on the surface, 0 outside.
  std::vector<int> coordinates(const Points& points, WeightRows* weights) const;

 private:
  std::unique_ptr<const CageMesh> mesh_;
};

}  // namespace softbody
