#pragma once

#include "softbody_common/geometry/types.h"

namespace softbody {

/// The place on the visual mesh that is closest to a point.
struct ClosestSurfacePoint {
  int triangle = -1;
  std::uint32_t piece = 0;                             ///< connected piece, 0..
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();    ///< unit, outward; zero if the triangle has no area
  float confidence = 0.0f;                             ///< 0..1
  float standard_deviation = 0.0f;                     ///< [m]; NaN: not estimated
};

/// The time is proportional to the number of triangles. Confidence and standard deviation are interpolated
/// over the triangle.
/// @param point in the frame of the state [m].
/// @throw std::invalid_argument if the mesh has no triangle, or state and topology do not fit together.
ClosestSurfacePoint closestSurfacePoint(const MeshTopology& topology, const MeshState& state,
                                        const Eigen::Vector3d& point);

}  // namespace softbody
