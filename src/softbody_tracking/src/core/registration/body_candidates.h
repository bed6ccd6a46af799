#pragma once

#include <vector>

#include "labels/region_colors.h"
#include "softbody_tracking/rgbd_frame.h"

namespace softbody {

/// A connected part of the depth image that may be the body.
struct BodyCandidate {
  Eigen::Vector3d center;  ///< mean of its points, camera frame [m]
  int pixels = 0;
};

/// A connected part of the depth image of any size.
struct DepthPart {
  BodyCandidate candidate;
  Eigen::Vector3d size_m;  ///< along its principal axes, the largest first
  double spread_m = 0.0;   ///< see spreadOf()
  bool at_border = false;  ///< it reaches the border of the image
  bool fits = false;       ///< it has about the body's size
  double rating = 0.0;     ///< lower is likelier to be the body: twice the logarithm of how its size differs,
                           ///< minus that of the pixels
  std::vector<int> pixels;  ///< row * columns + column
};

/// Pixels of the image that has the parts; a smaller part has no shape.
constexpr int kFewestPixels = 25;

/// Size of a set of points [m]: root mean square distance from the centre, scaled to the side of a uniform
/// square.
double spreadOf(const std::vector<Eigen::Vector3d>& points);

/// All parts of the depth image outside of large planes, the likeliest first. Parameters as
/// findBodyCandidates().
std::vector<DepthPart> findDepthParts(const RgbdFrame& frame, const RegionColors& colors, double diameter_m);

/// Parts of the depth image that may be the body, the likeliest first. A candidate has about the body's size
/// and is connected in depth. If the body's colours are known, it has these colours. It does not lie on a
/// plane much larger than the body (a table, a wall), even if objects before this plane divide it.
/// @param diameter_m of the body.
std::vector<BodyCandidate> findBodyCandidates(const RgbdFrame& frame, const RegionColors& colors,
                                              double diameter_m);

}  // namespace softbody
