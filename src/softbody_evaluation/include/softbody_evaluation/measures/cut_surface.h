#pragma once

#include "softbody_common/geometry/types.h"
#include "softbody_evaluation/measures/statistics.h"

namespace softbody::evaluation {

/// The surface of the result's cuts compared with the true cut surface, both in the rest body.
struct CutSurfaceReport {
  Summary distance;            ///< from the result's cut surface to the true one [m]
  Summary missed;              ///< from the true cut surface to the result's [m]
  Summary angle;               ///< between a triangle of the result and the nearest true one [rad]
  double tilt_rad = kNothing;  ///< of the whole cut surface; roughness cancels out
  double area_ratio = 0.0;     ///< area of the result / true area
};

/// Compares samples of equal area on the triangles that fill cuts, so the triangulation does not matter. The
/// summaries are empty if one of the two has no cut.
CutSurfaceReport compareCutSurfaces(const MeshTopology& result, const MeshTopology& truth);

}  // namespace softbody::evaluation
