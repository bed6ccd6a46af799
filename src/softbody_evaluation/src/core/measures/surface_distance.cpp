#include "softbody_evaluation/measures/surface_distance.h"

#include <Eigen/Dense>

#include "measures/corner_weights.h"
#include "softbody_sim/surface_mesh/closest_point.h"

namespace softbody::evaluation {
namespace {

constexpr std::size_t kPlaces = 2000;  // per frame: their mean is known to 2 % of the scatter
constexpr std::uint64_t kPlacesSeed = 1;

}  // namespace

std::vector<SurfaceSample> measuredPlaces(const MeshTopology& surface) {
  return sampleSurface({surface.rest_vertices, surface.triangles}, kPlaces, kPlacesSeed);
}

FrameSurfaceDistance surfaceDistance(const std::vector<SurfaceSample>& places, const Triangles& triangles,
                                     const MeshState& state, const MeshTopology& true_surface,
                                     const MeshState& truth) {
  const ClosestPointQuery query(truth.vertices, true_surface.triangles);
  FrameSurfaceDistance distances;
  for (const SurfaceSample& sample : places) {
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    for (int k = 0; k < 3; ++k)
      place += sample.weights[k] * state.vertices.row(triangles(sample.triangle, k)).transpose();
    const SurfacePoint nearest = query.closest(place);
    const auto corners = true_surface.triangles.row(nearest.triangle);
    const Eigen::Vector3d weights =
        cornerWeights(truth.vertices, {corners[0], corners[1], corners[2]}, nearest.position);
    const bool visible =
        interpolated(truth.confidence, true_surface.triangles, nearest.triangle, weights) > 0.5;
    (visible ? distances.visible : distances.hidden)
        .push_back(static_cast<float>((nearest.position - place).norm()));
  }
  return distances;
}

SurfaceDistanceReport summarize(const std::vector<FrameSurfaceDistance>& frames) {
  std::vector<float> all, visible, hidden;
  for (const FrameSurfaceDistance& frame : frames) {
    visible.insert(visible.end(), frame.visible.begin(), frame.visible.end());
    hidden.insert(hidden.end(), frame.hidden.begin(), frame.hidden.end());
  }
  all = visible;
  all.insert(all.end(), hidden.begin(), hidden.end());
  return {summarize(std::move(all)), summarize(std::move(visible)), summarize(std::move(hidden))};
}

}  // namespace softbody::evaluation
