#pragma once

#include <optional>
#include <vector>

#include "features/map_feature.h"
#include "features/orb_extractor.h"
#include "softbody_tracking/rgbd_frame.h"

namespace softbody {

/// Expected and measured position of a feature, camera frame [m]; many pairs are wrong.
struct PointPair {
  Eigen::Vector3d expected, measured;
  std::uint32_t piece = 0;  ///< the piece of the body that it lies on
};

/// Pairs keypoints of the whole image with the known features that look most like them, one to one.
/// @param vertices of the volume, as expected.
std::vector<PointPair> recognizedFeatures(const RgbdFrame& frame, const std::vector<MapFeature>& features,
                                          const std::vector<Keypoint>& keypoints, const SurfaceModel& model,
                                          const Points& vertices);

/// Largest error of a correct pair after a rigid motion [m]. It is not 0, because the piece is deformed and
/// depth is noisy.
/// @param rest_vertices of the piece.
double recognitionTolerance(const Points& rest_vertices);

/// The rigid motion that most pairs agree with (RANSAC, Fischler and Bolles 1981). Empty if the agreement of
/// these pairs may be chance. @param tolerance_m see recognitionTolerance().
std::optional<Eigen::Isometry3d> recognizedMotion(const std::vector<PointPair>& pairs, double tolerance_m);

/// Vertices of each wanted piece, moved to the place where its pairs recognise it.
/// @param wanted for each piece. @return for each piece; empty if the piece is not wanted, not recognised, or
/// moved by no more than min_motion_m.
std::vector<Points> recognizedPieces(const std::vector<PointPair>& pairs, const PredictedSurface& surface,
                                     const std::vector<bool>& wanted, double min_motion_m);

}  // namespace softbody
