#pragma once

#include <memory>

#include "outline/crease_associations.h"
#include "outline/outline_associations.h"
#include "prediction/predicted_surface.h"
#include "prediction/surface_samples.h"
#include "softbody_tracking/tracker_config.h"

namespace softbody {

/// What a view samples.
struct ViewSettings {
  explicit ViewSettings(const TrackerConfig& config);

  int wanted_samples;  ///< of the surface
  bool contours;       ///< false: neither outline nor creases
};

/// A prediction of the body as the camera should see it, sampled where it is compared with a frame. A value:
/// rendering another one does not change it.
struct View {
  PredictedSurface surface;
  SurfaceSamples samples;
  OutlineSamples outline;
  CreaseSamples creases;
};

/// Renders the body's prediction; no other function does. @param volume_vertices camera frame [m].
View render(std::shared_ptr<const SurfaceModel> model, const Pinhole& camera, const Points& volume_vertices,
            const ViewSettings& settings, RasterMemory* memory);

}  // namespace softbody
