#pragma once

#include <vector>

#include "registration/surface_samples.h"
#include "softbody_sim/surface_mesh/closest_point.h"

namespace softbody::scanning {

/// A surface with points on it, ready for closest points.
class RegistrationSide {
 public:
  RegistrationSide(const RegisteredSurface& surface, int samples);

  /// The closest place, its normal and its colour.
  struct Closest {
    Eigen::Vector3d position, normal, color;
    bool seen;
  };
  Closest closest(const Eigen::Vector3d& point) const;

  const std::vector<SurfaceSample>& samples() const { return samples_; }
  /// Seen vertices, each the mean of itself and its neighbours, against noise.
  const std::vector<Eigen::Vector3d>& seenPlaces() const { return seen_places_; }
  /// Centre of the volume.
  const Eigen::Vector3d& middle() const { return middle_; }
  const std::optional<Eigen::Hyperplane<double, 3>>& table() const { return surface_.table; }
  /// Diagonal of the bounding box [m].
  double diagonal() const;

 private:
  const RegisteredSurface& surface_;
  ClosestPointQuery query_;
  std::vector<SurfaceSample> samples_;
  std::vector<Eigen::Vector3d> seen_places_;
  Eigen::Vector3d middle_;
};

}  // namespace softbody::scanning
