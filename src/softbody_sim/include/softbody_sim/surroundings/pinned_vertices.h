#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "softbody_common/geometry/types.h"
#include "softbody_sim/constraints/surroundings.h"
#include "softbody_sim/object/pin_region.h"
#include "softbody_sim/surroundings/body_surface.h"

namespace softbody {

/// The vertices of a pin region, held at fixed positions in the region's frame. A box in a frame chooses its
/// vertices when it takes hold. Surfaces are in the volume whose vertices are given.
class PinnedVertices {
 public:
  /// @throw std::invalid_argument if a box in rest space holds nothing. The error names what is nearest.
  PinnedVertices(PinRegion region, const BodySurface& surface, const Points& rest_vertices);

  const PinRegion& region() const { return region_; }
  std::size_t vertexCount() const { return vertices_.size(); }
  /// Whether the held positions are known.
  bool hasPositions() const { return positions_.has_value(); }

  /// Holds the vertices where they are now; a box in a frame, those that lie in it now. @param vertices #V by
  /// 3, in the targets' frame [m].
  void hold(const BodySurface& surface, const Eigen::Isometry3d& frame_pose, const Points& vertices);
  void forgetPositions() { positions_.reset(); }

  /// Adds the region's new vertices after a cut, held where they are now.
  /// @param vertices in the targets' frame [m]; empty if the body is not placed.
  void updateVertices(const BodySurface& surface, const Points& rest_vertices, const Points& vertices);

  /// The region acts from the first pose of its frame on. @param pose in the targets' frame; empty: the last
  /// one stays.
  void setFramePose(const std::optional<Eigen::Isometry3d>& pose);
  const Eigen::Isometry3d& framePose() const { return frame_pose_; }
  bool acts() const { return acts_; }

  /// Appends one pin per vertex, ascending, in the targets' frame.
  /// @param accuracy_m standard deviation of their positions.
  void appendPins(double accuracy_m, std::vector<Pin>* pins) const;

 private:
  PinRegion region_;
  std::vector<int> vertices_;
  std::optional<Points> positions_;  ///< in the region's frame [m]
  Eigen::Isometry3d frame_pose_ = Eigen::Isometry3d::Identity();
  bool acts_ = false;
};

}  // namespace softbody
