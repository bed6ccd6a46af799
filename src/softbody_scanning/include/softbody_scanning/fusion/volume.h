#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "softbody_common/geometry/types.h"
#include "softbody_scanning/fusion/depth_view.h"

namespace softbody::scanning {

/// What all views say about one place.
struct PlaceEvidence {
  float distance = 0.0f;  ///< signed distance from the surface, outside positive, cut off at the reach [m]
  float weight = 0.0f;    ///< inverse variance of the distance [1/m^2]; 0: no view says anything
  float seen = 0.0f;      ///< the part of the weight that measured a surface at this place, up to noise
  int behind = 0;         ///< number of views in which a surface hides this place
  int measured = 0;       ///< number of views that measured a surface at this place, up to noise
  int empty = 0;          ///< number of views that looked through this place
};

/// A block of space that is fused.
struct FusionBox {
  Eigen::AlignedBox3d box;  ///< model frame [m]
  double voxel_m = 1e-3;
  double reach_m = 4e-3;  ///< how far from a surface its depth still counts
};

/// Signed distances on a regular grid (Curless and Levoy 1996): the weighted mean of the distances to the
/// tangent planes of all views. What no view looked through counts as inside, what no view had in its image
/// as outside, so the surface is closed.
class Volume {
 public:
  /// @param inverse_depth_std see measureInverseDepthNoise().
  Volume(const FusionBox& box, const std::vector<DepthView>& views, double inverse_depth_std);

  const FusionBox& box() const { return box_; }
  const Eigen::Vector3i& size() const { return size_; }  ///< number of grid points
  Eigen::Vector3d place(const Eigen::Vector3i& index) const {
    return box_.box.min() + box_.voxel_m * index.cast<double>();
  }
  const PlaceEvidence& at(const Eigen::Vector3i& index) const { return places_[offset(index)]; }
  /// Signed distance there: that of the evidence, or the reach with the sign of what is taken for it.
  float distance(const Eigen::Vector3i& index) const;
  /// Takes back what was seen below a plane, where the table and what stands on it are not told apart: it may
  /// be inside. @param table the table, with its normal up. @param clear_m the height.
  void forgetBelow(const Eigen::Hyperplane<double, 3>& table, double clear_m);
  /// Adds the evidence of a volume on the same grid.
  void add(const Volume& other);

  /// Share of what is known about the grid points around a place that measured a surface there, 0..1; less if
  /// it is less than one view. The best of them counts. @param depth_std_m of one view.
  float seenAround(const Eigen::Vector3d& place, double depth_std_m) const;

 private:
  std::size_t offset(const Eigen::Vector3i& i) const {
    return (static_cast<std::size_t>(i.z()) * size_.y() + i.y()) * size_.x() + i.x();
  }

  FusionBox box_;
  Eigen::Vector3i size_;
  std::vector<PlaceEvidence> places_;
};

}  // namespace softbody::scanning
