#pragma once

#include <vector>

#include "softbody_common/types.h"

namespace softbody {

/// Per side of a polygon, in how many parts samples at most `spacing` apart divide it; further apart where
/// they would be more than some hundreds, as on a blade that is much larger than the body.
std::vector<int> partsOfSides(const Points& polygon, double spacing);

/// Samples along a closed polygon, from its first corner on.
Points sampleOutline(const Points& polygon, const std::vector<int>& parts);

/// A blade's outline, sampled and hardly bent.
class BladeOutline {
 public:
  /// @param points as sampleOutline gave them, wherever they are now.
  BladeOutline(Points points, std::vector<int> parts);

  const Points& points() const { return points_; }
  const Eigen::Vector3d& normal() const { return normal_; }

  /// The outline of a blade smaller by a distance all round, nearly: at a corner by some less [m].
  Points setBack(double distance) const;

  int sideFrom(int sample) const;  ///< that goes on from the sample
  int sideTo(int sample) const;    ///< that comes to it: another one at a corner
  Eigen::Vector3d sideNormal(int side) const { return side_normals_.row(side); }

  /// Samples, in order, of the sides that face a way, unit and in the blade's plane.
  std::vector<int> leadingEdge(const Eigen::Vector3d& way) const;

  /// In the blade's plane, of samples of an edge, #edge by 3; of a corner the mean of its sides'.
  Points outwardNormals(const std::vector<int>& edge) const;

 private:
  int sides() const { return static_cast<int>(parts_.size()); }
  int next(int sample) const { return (sample + 1) % static_cast<int>(points_.rows()); }

  Points points_;
  std::vector<int> parts_;
  std::vector<int> corners_;  ///< first sample of every side
  Eigen::Vector3d normal_;    ///< the outline runs counter-clockwise about it
  Points side_normals_;       ///< outward
};

}  // namespace softbody
