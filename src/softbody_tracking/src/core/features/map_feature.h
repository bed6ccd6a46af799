#pragma once

#include <Eigen/Core>

#include "features/orb_extractor.h"
#include "patches/feature_patch.h"
#include "prediction/memory.h"
#include "prediction/predicted_surface.h"

namespace softbody {

/// Where a feature lies in the rest body, and how this place changes with the pixel in its patch's image.
struct FeaturePlace {
  MaterialPoint place;
  PlaceGradient gradient = PlaceGradient::Zero();
};

/// A feature bound to the body, with descriptor and patch as first seen.
struct MapFeature : FeaturePlace {
  int id = 0;
  Descriptor descriptor{};
  FeaturePatch patch;
  FeaturePlace first;                                   ///< as bound at admission
  Eigen::Matrix4d first_tet = Eigen::Matrix4d::Zero();  ///< corners of its tet then, see homogeneousCorners()
  Eigen::Index first_vertices = 0;                      ///< number of the body's vertices then
  Eigen::Vector3d reference = Eigen::Vector3d::Zero();  ///< measured position at admission, fixed frame [m]
  double place_variance = 0.0;                          ///< of its place, as known at admission [m^2]
  double expected_s = 0.0;                              ///< time for which it was expected
  double found_s = 0.0;                                 ///< time of this for which it was found

  /// Probability that it is found where it is expected (rule of succession: it was found at admission).
  double hitRate() const { return (found_s + kAdmission_s) / (expected_s + kAdmission_s); }
  /// Time [s] that the admission counts for: one frame at 30 Hz.
  static constexpr double kAdmission_s = 1.0 / 30.0;
};

/// Corners of a tet at rest as columns (x, y, z, 1). This matrix maps barycentric coordinates to the rest
/// shape.
inline Eigen::Matrix4d homogeneousCorners(const TetTopology& volume, int tet) {
  Eigen::Matrix4d corners = Eigen::Matrix4d::Ones();
  for (int k = 0; k < 4; ++k) corners.col(k).head<3>() = volume.rest_vertices.row(volume.tets(tet, k));
  return corners;
}

}  // namespace softbody
