#pragma once

#include "softbody_common/types.h"
#include "softbody_evaluation/measures/statistics.h"

namespace softbody::evaluation {

/// The surface that the result's cuts have made against the true one, both in the rest body.
struct CutSurfaceReport {
  Summary distance;            ///< from points of the result's surface to the true one [m]
  Summary missed;              ///< from points of the true surface to the result's [m]
  Summary angle;               ///< between the result's triangles and the true one nearest to each [rad]
  double tilt_rad = kNothing;  ///< of the result's surface as a whole: roughness cancels out
  double area_ratio = 0.0;     ///< the result's area by the true one
};

/// Samples of equal area on the triangles that fill cuts, so that the figures do not depend on the
/// triangulation. Empty summaries where one of the two has no cut.
CutSurfaceReport compareCutSurfaces(const MeshTopology& result, const MeshTopology& truth);

}  // namespace softbody::evaluation
