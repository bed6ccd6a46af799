#pragma once

#include "labels/labels.h"
#include "labels/region_colors.h"
#include "prediction/surface_samples.h"
#include "softbody_tracking/rgbd_frame.h"

namespace softbody {

/// Labels the pixels of the rendered body and around it: the one place that decides whether a pixel shows the
/// body. First each pixel is judged by its depth beside the prediction and by its colour, then cells of
/// pixels by these, by the cells beside them and by the last frame.
/// @param samples of the rendered surface. @param last memory of the last frame's labels; may be empty.
/// @param error_m how far predictions were off in the last frames.
Labels labelsOf(const RgbdFrame& frame, const PredictedSurface& surface, const SurfaceSamples& samples,
                const RegionColors& colors, const LabelMemory& last, double error_m);

}  // namespace softbody
