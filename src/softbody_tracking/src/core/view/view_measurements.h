#pragma once

#include "depth/depth_associations.h"
#include "outline/outline_associations.h"
#include "view/view.h"

namespace softbody {

/// How much the measurements of a frame count.
struct MeasurementWeights {
  MeasurementWeights(const TrackerConfig& config, const TetTopology& volume);

  DepthWeight depth;
  ContourWeight contour;
};

/// The depth of a frame on a view whose pieces are moved, see associateDepth().
DepthAssociations depthOf(const RgbdFrame& frame, const View& view, const RigidMotions& motions,
                          const Labels& labels, const MeasurementWeights& weights, int pixel_step = 1);

/// The contours of a view in a frame: its outline and its creases, see associateOutline() and
/// associateCreases(). None if the view has no samples of them.
OutlineAssociations contoursOf(const RgbdFrame& frame, const View& view, const RigidMotions& motions,
                               const Labels& labels, const MeasurementWeights& weights);

}  // namespace softbody
