#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <optional>

namespace softbody {

/// What a search for the undeformed body measured in one frame. Lengths in metres, shares 0..1.
struct SearchReport {
  bool found = false;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  ///< of the best candidate, camera frame
  int alike = 1;  ///< poses in the same place that explain the frame equally well

  Eigen::Vector3d body_m = Eigen::Vector3d::Zero();  ///< sides of the mesh's bounding box, the largest first
  double depth_share = 0.0;                          ///< pixels with depth
  double nearest_m = 0.0, farthest_m = 0.0;          ///< of all depth; 0 without depth

  /// Of the part of the depth image that is most like the body; a size of 0: no part stands free.
  Eigen::Vector3d part_m = Eigen::Vector3d::Zero();  ///< along its principal axes, the largest first
  double part_distance_m = 0.0;
  bool part_fits = false;       ///< it has about the body's size
  bool part_at_border = false;  ///< it reaches the border of the image

  /// Of the best pose; a cost of 1: no pose was tried.
  double cost = 1.0;                                   ///< see docs/pipeline/registration.md
  double agreeing = 0.0, nearer = 0.0, farther = 0.0;  ///< pixels of the mesh; the others have no depth
  double hidden = 0.0;        ///< pixels of the mesh before which another part is nearer
  double difference_m = 0.0;  ///< median difference of depth
  double continuing = 0.0;    ///< pixels just outside the outline whose depth continues the surface
  double confined = 0.0;      ///< see confinement()
  double without_edge = 0.0;  ///< outline at which depth runs straight on
  bool near_pose = false;     ///< the body was sought only near a rough pose
  bool outside = false;       ///< the best pose is farther from that one than its uncertainty
  double shift_m = 0.0;       ///< of the best pose from it
  double turn_rad = 0.0;      ///< the same
  /// If a body with a picture was not found: number of poses that were tried (0: no picture, or near a pose),
  /// that depth refuses, and at which something else than the picture is seen.
  std::size_t pictured = 0, refused_by_depth = 0, refused_by_picture = 0;
  bool several_places = false;  ///< the picture is seen in several places
  /// The mesh times this factor would be found; empty: no such factor is known.
  std::optional<double> fitting_scale;
};

}  // namespace softbody
