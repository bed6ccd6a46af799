#pragma once

#include <vector>

#include "labels/labels.h"
#include "outline/contour_association.h"
#include "prediction/predicted_surface.h"
#include "softbody_tracking/rgbd_frame.h"

namespace softbody {

/// A sample of a crease, and the normals of the sides before and behind it.
struct CreaseSample : ContourSample {
  Eigen::Vector3d before, behind;
};

/// The creases of a rendered surface.
struct CreaseSamples {
  std::vector<CreaseSample> samples;
  int spacing_px = 1;  ///< between neighbouring samples
};
CreaseSamples sampleCreases(const PredictedSurface& surface);

/// Associates the predicted creases, where two sides of the body meet at an angle, with the edges in the
/// image that light and shadow make of them. On a body of one colour only they show where along its surface a
/// point lies.
/// @param surface as sampled. @param motions of the body's pieces since then.
/// @return only the creases that the frame shows.
std::vector<Association> associateCreases(const RgbdFrame& frame, const PredictedSurface& surface,
                                          const CreaseSamples& samples, const RigidMotions& motions,
                                          const Labels& labels, const ContourWeight& weight);

}  // namespace softbody
