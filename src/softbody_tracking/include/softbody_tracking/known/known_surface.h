#pragma once

#include <string>
#include <vector>

#include "softbody_common/geometry/types.h"
#include "softbody_tracking/rgbd_frame.h"

namespace softbody {

/// A surface that is known to be in view, such as another tracked body or a robot's link.
struct KnownSurface {
  std::string name;
  TriangleMesh surface;      ///< camera frame [m]
  double deviation_m = 0.0;  ///< standard deviation of its place
};

/// The frame with its pixels that show known surfaces, see RgbdFrame::known. A pixel shows one of them if its
/// depth agrees within three standard deviations of measurement and place, or if nothing is measured where
/// one is rendered. Something else may lie before a known surface: then depth does not agree.
/// @throw std::invalid_argument if a triangle names a vertex that is not there.
RgbdFrame withKnownSurfaces(RgbdFrame frame, const std::vector<KnownSurface>& surfaces);

/// The frame without depth where it shows known surfaces: for a search, to which they must not look like the
/// body. Copies the depth only if there are known surfaces.
RgbdFrame withoutKnownDepth(const RgbdFrame& frame);

}  // namespace softbody
