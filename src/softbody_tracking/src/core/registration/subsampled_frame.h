#pragma once

#include "softbody_tracking/rgbd_frame.h"

namespace softbody {

/// Every k-th pixel of a frame in both directions, and the camera of this smaller image.
/// @param columns k is chosen so that about this many columns remain; a smaller frame is returned as it is.
RgbdFrame subsampled(const RgbdFrame& frame, int columns);

}  // namespace softbody
