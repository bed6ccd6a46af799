#pragma once

#include "softbody_common/geometry/types.h"
#include "softbody_tracking/rgbd_frame.h"

namespace softbody {

/// Removes a tracked blade from frames. Inside a cut there is no depth step between blade and body, so the
/// blade would be taken for the body.
class ToolMask {
 public:
  static constexpr Nanoseconds kBladeValidity =
      200'000'000;  ///< [ns] a blade is used this long before and after its stamp

  /// @param blade planar polygon in the fixed frame, #B by 3 [m].
  void setBlade(Nanoseconds stamp, const Points& blade);

  /// The frame with depth removed, and `covered` set, at points within 8 mm of the blade. Pixels without
  /// depth are covered if the blade lies there in the image: a shiny blade returns no depth. Returns the
  /// frame itself if no blade is valid at its stamp, or if the blade comes nearer than 1 cm to the camera
  /// plane.
  RgbdFrame withoutBlade(const RgbdFrame& frame) const;

 private:
  Nanoseconds stamp_ = 0;
  Points blade_;  ///< fixed frame
};

}  // namespace softbody
