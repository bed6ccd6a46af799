#pragma once

#include <vector>

#include "association.h"
#include "color_model.h"
#include "softbody_tracking/rgbd_frame.h"
#include "softbody_tracking/tracker_config.h"
#include "surface_samples.h"

namespace softbody {

/// What the depth image says of the predicted surface.
struct DepthAssociations {
  std::vector<Association> associations;
  int visible_blocks = 0;   ///< blocks of pixels that the prediction covers and the camera measured
  int occluded_blocks = 0;  ///< something nearer, or of another colour, stands there
  int absent_blocks = 0;    ///< the camera looks through: the body is not where it was predicted
};

/// Associates visible surface with the depth measured along the same rays (projective association, point to
/// plane). A block of pixels gives one association, with the mean of its depth differences. What goes on from
/// an occluder without a step in depth, nearer than the body should be, belongs to the occluder.
/// @param image the surface as rendered when it was sampled. @param motions of the body's pieces since then.
/// @param volume_edge_m mean edge of the tets: depth weights are per square of it.
DepthAssociations associateDepth(const RgbdFrame& frame, const RasterImage& image,
                                 const SurfaceSamples& surface, const RigidMotions& motions,
                                 const ColorModel& colors, double volume_edge_m, const DepthConfig& config);

}  // namespace softbody
