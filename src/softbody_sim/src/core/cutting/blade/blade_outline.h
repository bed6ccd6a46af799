#pragma once

#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// Per side of a polygon, the number of parts between samples at most `spacing` apart. A very large blade
/// gets a wider spacing, so that it has at most some hundred samples.
std::vector<int> partsOfSides(const Points& polygon, double spacing);

/// Samples along a closed polygon, beginning at its first corner.
Points sampleOutline(const Points& polygon, const std::vector<int>& parts);

/// The sampled outline of a blade. In rest space it can be slightly bent.
class BladeOutline {
 public:
  /// @param points of sampleOutline, in any frame.
  BladeOutline(Points points, std::vector<int> parts);

  const Points& points() const { return points_; }
  const Eigen::Vector3d& normal() const { return normal_; }

  /// The outline moved inward by a distance [m], at a corner by slightly less.
  Points setBack(double distance) const;

  int sideFrom(int sample) const;  ///< the side that begins or continues at the sample
  int sideTo(int sample) const;    ///< the side that ends or continues at the sample
  Eigen::Vector3d sideNormal(int side) const { return side_normals_.row(side); }

  /// Samples, in order, of the sides that face a direction of motion. @param way unit vector in the blade's
  /// plane.
  std::vector<int> leadingEdge(const Eigen::Vector3d& way) const;

  /// Outward normals of samples of an edge, in the blade's plane, #edge by 3. A corner has the mean of its
  /// sides.
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
