#pragma once

#include <optional>
#include <vector>

#include "features/feature_map.h"
#include "features/orb_extractor.h"
#include "softbody_tracking/rgbd_frame.h"

namespace softbody {

/// Where a feature lies in the body as it is expected, and where it may have been measured.
struct PointPair {
  Eigen::Vector3d expected, measured;
  std::uint32_t body = 0;  ///< the piece that it lies on
};

/// The keypoints, wherever they are, that look most like known features, one to one; many of them are wrong.
/// @param vertices of the surface's volume, as they are expected. @param max_hamming_distance between
/// descriptors, of 256 bits.
std::vector<PointPair> recognizedFeatures(const RgbdFrame& frame, const std::vector<MapFeature>& features,
                                          const std::vector<Keypoint>& keypoints,
                                          const PredictedSurface& surface, const Points& vertices,
                                          int max_hamming_distance);

/// By how much the places of recognised features may be off [m]: the piece has been deformed, and depth is
/// noisy. @param rest_vertices of the piece.
double recognitionTolerance(const Points& rest_vertices);

/// The rigid motion that most pairs agree with (RANSAC, Fischler and Bolles 1981), if they are enough for it
/// not to be chance.
/// @param tolerance_m by which they may be off: see recognitionTolerance().
std::optional<Eigen::Isometry3d> recognizedMotion(const std::vector<PointPair>& pairs, double tolerance_m);

/// The volume's vertices of pieces where their pairs say that they are.
/// @param wanted of each piece. @return of each; none where it is not wanted, not recognised, or nowhere
/// further than min_motion_m from where it is expected.
std::vector<Points> recognizedPieces(const std::vector<PointPair>& pairs, const PredictedSurface& surface,
                                     const std::vector<bool>& wanted, double min_motion_m);

}  // namespace softbody
