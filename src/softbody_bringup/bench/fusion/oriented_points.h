#pragma once

#include <vector>

#include "softbody_scanning/fusion/volume.h"

namespace softbody::scanning {

/// The depth of one recording in the frame of the body, and the table below it.
struct RecordedSide {
  std::vector<DepthView> views;
  Eigen::Hyperplane<double, 3> table;
};

/// Points of a surface with their normals, outward, #P by 3.
struct OrientedPoints {
  Points positions, normals;
};

/// The tangent planes of all pixels in a box: one weighted mean in each cell. The weight is that of Volume:
/// the cosine of the angle of view over the variance of depth.
/// @param spacing_m size of a cell. @param clear_m height up to which a pixel may show the table.
OrientedPoints orientedPoints(const std::vector<RecordedSide>& sides, const FusionBox& box, double spacing_m,
                              double clear_m);

}  // namespace softbody::scanning
