#pragma once

#include <vector>

#include "outline/outline_line.h"
#include "prediction/association.h"
#include "prediction/predicted_surface.h"
#include "softbody_tracking/rgbd_frame.h"

namespace softbody {

/// The outline of a rendered surface.
struct OutlineSamples {
  std::vector<ContourSample> samples;
  int spacing_px = 1;  ///< between neighbouring samples
  int covered_px = 1;  ///< pixels that show the body
};
OutlineSamples sampleOutline(const PredictedSurface& surface);

/// The predicted outline compared with a frame.
struct OutlineAssociations {
  std::vector<Association> associations;  ///< only the distance across the outline in the image counts
  /// Area between predicted and measured outline, as a share of the body's area in the image. Only lines that
  /// contradict the prediction count: one that knows little says nothing against it. Where the outline is
  /// hidden, it is assumed to be as elsewhere.
  double disagreement = 0.0;
  /// The same, positive where the image's outline is outside of the predicted one, negative inside.
  double excess = 0.0;
  double deviation_px = 0.0;  ///< usual standard deviation of the measured outline [px]; 0: not measured
};

/// Associates the predicted outline with the body's outline in the frame, along the outline's normal in the
/// image: region-based tracking (Stoiber et al. 2022, SRT3D), with colour and depth as evidence. It corrects
/// errors perpendicular to the line of sight, which depth along the rays does not show.
/// @param image the rendered surface that the samples were taken from.
/// @param motions of the body's pieces since then.
OutlineAssociations associateOutline(const RgbdFrame& frame, const RasterImage& image,
                                     const OutlineSamples& samples, const RigidMotions& motions,
                                     const Labels& labels, const ContourWeight& weight);

}  // namespace softbody
