#pragma once

#include <vector>

#include "softbody_common/geometry/types.h"
#include "softbody_evaluation/measures/statistics.h"
#include "softbody_evaluation/measures/surface_samples.h"

namespace softbody::evaluation {

/// Distances from places of a surface to the nearest places of the true one [m], of one frame. They do not
/// see sliding along the surface.
struct FrameSurfaceDistance {
  std::vector<float> visible, hidden;  ///< by the truth's confidence at the nearest place
};

/// Places of the surface that are measured in each of its states. Each has an equal share of the area at
/// rest, so the distances of two meshes of one body are comparable, whatever their vertices are.
/// @throw std::invalid_argument if the surface has no area.
std::vector<SurfaceSample> measuredPlaces(const MeshTopology& surface);

/// @param places from measuredPlaces. @param triangles of the surface.
FrameSurfaceDistance surfaceDistance(const std::vector<SurfaceSample>& places, const Triangles& triangles,
                                     const MeshState& state, const MeshTopology& true_surface,
                                     const MeshState& truth);

/// Over all frames [m].
struct SurfaceDistanceReport {
  Summary all, visible, hidden;
};

SurfaceDistanceReport summarize(const std::vector<FrameSurfaceDistance>& frames);

}  // namespace softbody::evaluation
