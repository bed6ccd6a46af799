#include "scenes/tear_scene.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "bodies/plane_cut.h"
#include "motion/motion_profiles.h"
#include "softbody_virtual_camera/bodies/shapes.h"

namespace softbody::virtual_camera {
namespace {

constexpr double kTearPlace = 0.01;                                        // x of the tear [m]
constexpr double kTearLeeway = 2e-3;                                       // as for cuts [m]
constexpr double kStrength = 0.5;                                          // strain that tears the body
constexpr double kReach = 0.04;                                            // width of the stretched part [m]
constexpr double kPoissonRatio = 0.2;                                      // the sections get thinner
constexpr double kBegin = 0.5, kPull = 2.0, kRelax = 0.25, kAfter = 1.75;  // [s]

/// Half of the length that the body gains for a largest strain of 1 [m].
double gain() { return 0.5 * kReach * std::sqrt(M_PI); }

/// Strain in the section of the tear.
double strainAt(double t) {
  const double tear = kBegin + kPull;
  if (t < tear) return kStrength * std::clamp((t - kBegin) / kPull, 0.0, 1.0);
  return kStrength * (1.0 - smoothStep((t - tear) / kRelax));
}

/// The strain falls off with the distance from the section: e(s) = strain exp(-(s / kReach)^2).
/// @param apart distance that each end has moved outwards [m]. @param side 1 or -1: of the tear.
Eigen::Vector3d stretched(const Eigen::Vector3d& rest, double section, double strain, double apart,
                          double side) {
  const double s = (rest.x() - section) / kReach;
  const double across = std::pow(1.0 + strain * std::exp(-s * s), -kPoissonRatio);
  const double moved = strain * gain() * std::erf(s) + side * (apart - strain * gain());
  return {rest.x() + moved, across * rest.y(), across * rest.z()};
}

/// The section of the body with the tear, as a rectangle around it [m].
TriangleMesh sectionPatch(const Points& rest, double section) {
  const Eigen::Vector3d low = rest.colwise().minCoeff(), high = rest.colwise().maxCoeff();
  return rectangle({section, low.y(), low.z()}, {0.0, high.y() - low.y(), 0.0},
                   {0.0, 0.0, high.z() - low.z()});
}

}  // namespace

Scene tearScene(const Stage& stage) {
  const MeshTopology whole = topologyOf({stage.actors.at(0).rest, stage.actors.at(0).skin});
  PlaneCut plane;
  plane.T_rest_cut.translation().x() = kTearPlace;
  plane = clearOfVertices(whole.rest_vertices, plane, kTearLeeway);
  const double section = plane.T_rest_cut.translation().x();
  const CutMesh torn = cutByPlane(whole, plane);

  Play play;
  play.duration_s = kBegin + kPull + kRelax + kAfter;
  play.repeats = false;
  play.deformation = [section](const Eigen::Vector3d& rest, double t) {
    return stretched(rest, section, strainAt(t), 0.0, 0.0);
  };
  Scene scene = perform(stage, play);
  scene.edits = {{torn.topology, torn.triangle_parents, sectionPatch(whole.rest_vertices, section)}};
  scene.state = [=, before = scene.state](double t) {
    SceneState state = before(t);
    if (t < kBegin + kPull) return state;
    state.revision = 1;
    Points pieces(torn.topology.rest_vertices.rows(), 3);
    for (Eigen::Index i = 0; i < pieces.rows(); ++i) {
      const double side = torn.beyond[static_cast<std::size_t>(i)] ? 1.0 : -1.0;
      pieces.row(i) =
          stretched(torn.topology.rest_vertices.row(i), section, strainAt(t), kStrength * gain(), side);
    }
    state.vertices.at(0) = transformed(state.T_camera_body, pieces);
    return state;
  };
  return scene;
}

}  // namespace softbody::virtual_camera
