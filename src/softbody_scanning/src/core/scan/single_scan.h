#pragma once

#include <optional>

#include "softbody_scanning/fusion/volume.h"
#include "softbody_scanning/scan/scanned_body.h"

namespace softbody::scanning {

constexpr double kEdgeVoxels = 2.0;  ///< edge of the final triangles

/// The depth of one recording, and where its object is.
struct SingleScan {
  std::vector<DepthView> views;
  double inverse_depth_std = 0.0;     ///< [1/m]
  double depth_std_m = 0.0;           ///< of one pixel at the object
  Eigen::AlignedBox3d box;            ///< around the object, with a margin [m]
  std::optional<Eigen::Vector3d> at;  ///< see PosedRecording

  /// Height below which the table and what stands on it are not told apart.
  double clear(double voxel_m) const { return std::max(depth_std_m, voxel_m); }
};

/// @throw std::invalid_argument as scanBody.
SingleScan prepareScan(const PosedRecording& recording);

FusionBox fusionBox(const Eigen::AlignedBox3d& box, double voxel_m, double depth_std_m);

/// The surface of one recording alone, its underside closed flat. @throw std::invalid_argument if there is
/// none.
RegisteredSurface surfaceOfScan(const SingleScan& scan, double voxel_m);

/// Share of the surface around each vertex that was measured, 0..1. @param depth_std_m of one view.
std::vector<float> seenOf(const Volume& volume, const TriangleMesh& mesh, double depth_std_m);

}  // namespace softbody::scanning
