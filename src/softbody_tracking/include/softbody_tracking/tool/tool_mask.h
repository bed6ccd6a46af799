#pragma once

#include "softbody_common/types.h"
#include "softbody_tracking/rgbd_frame.h"

namespace softbody {

/// Takes a tracked blade out of a frame: it stands in the body that it cuts, without a step in depth,
/// and would be taken for the body.
class ToolMask {
 public:
  static constexpr Nanoseconds kBladeValidity = 200'000'000;  ///< a blade counts so long before and after

  /// @param blade planar polygon in the fixed frame, #B by 3 [m].
  void see(Nanoseconds stamp, const Points& blade);

  /// The frame without depth, and covered, within 8 mm of the blade where that was seen last; covered as well
  /// where it has no depth, which a shiny blade does not return, there in the image. The frame as it
  /// is where no blade was seen up to kBladeValidity before or after, or where it reaches nearer than 1 cm to
  /// the camera plane.
  RgbdFrame without(const RgbdFrame& frame) const;

 private:
  Nanoseconds stamp_ = 0;
  Points blade_;  ///< fixed frame
};

}  // namespace softbody
