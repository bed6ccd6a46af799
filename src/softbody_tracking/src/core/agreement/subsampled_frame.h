#pragma once

#include "softbody_tracking/rgbd_frame.h"

namespace softbody {

/// Columns of the images of a search: its last step sees pixels of some millimetres, each step before it half
/// as many.
constexpr int kLargeColumns = 320, kMediumColumns = kLargeColumns / 2, kSmallColumns = kMediumColumns / 2;

/// Every k-th pixel of a frame in both directions, and the camera of this smaller image.
/// @param columns k is chosen so that about this many columns remain; a smaller frame is returned as it is.
RgbdFrame subsampled(const RgbdFrame& frame, int columns);

}  // namespace softbody
