#include "view/view.h"

#include <utility>

namespace softbody {

ViewSettings::ViewSettings(const TrackerConfig& config)
    : wanted_samples(config.max_depth_targets), contours(config.outline_weight > 0.0) {}

View render(std::shared_ptr<const SurfaceModel> model, const Pinhole& camera, const Points& volume_vertices,
            const ViewSettings& settings, RasterMemory* memory) {
  PredictedSurface surface(std::move(model), camera, volume_vertices, memory);
  SurfaceSamples samples = sampleSurface(surface, settings.wanted_samples);
  OutlineSamples outline;
  CreaseSamples creases;
  if (settings.contours) {
    outline = sampleOutline(surface);
    creases = sampleCreases(surface);
  }
  return {std::move(surface), std::move(samples), std::move(outline), std::move(creases)};
}

}  // namespace softbody
