#include "comparison/other_mesh.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <stdexcept>

#include "measures/material_match.h"
#include "measures/rest_symmetry.h"
#include "softbody_common/geometry/rigid_fit.h"
#include "softbody_evaluation/measures/surface_samples.h"
#include "softbody_evaluation/measures/vertex_match.h"
#include "softbody_evaluation/models/model_fit.h"
#include "softbody_sim/surface_mesh/closest_point.h"

namespace softbody::evaluation {
namespace {

constexpr std::size_t kComparedPlaces = 2000;
constexpr double kOtherBody = 0.02;  // mean distance at rest, of the diagonal: 5 mm of 250 mm is no scan

Model restModel(const std::string& name, const MeshTopology& mesh) {
  Model model;
  model.name = name;
  model.mesh = {mesh.rest_vertices, mesh.triangles};
  return model;
}

/// The motion from the result's rest shape to the true one by which the tracker took the body in its first
/// tracked frame. Empty: no such frame.
std::optional<Eigen::Isometry3d> motionTaken(const std::vector<StatusRecord>& statuses,
                                             const SurfaceRecord& truth, const SurfaceRecord& result) {
  Nanoseconds tracked = 0;
  const auto is_tracking = [](const StatusRecord& s) { return s.state == TrackingState::kTracking; };
  const auto first = std::find_if(statuses.begin(), statuses.end(), is_tracking);
  if (first != statuses.end()) tracked = first->stamp;
  for (auto state = result.states.lower_bound(tracked); state != result.states.end(); ++state) {
    const auto expected = truth.states.find(state->first);
    if (expected == truth.states.end()) continue;
    const Eigen::Isometry3d T_result =
        fitRigid(topologyOf(result, state->second).rest_vertices, state->second.vertices);
    const Eigen::Isometry3d T_truth =
        fitRigid(topologyOf(truth, expected->second).rest_vertices, expected->second.vertices);
    return T_truth.inverse() * T_result;
  }
  return std::nullopt;
}

/// Mean distance at rest from the one surface, moved, to the other [m].
double meanDistance(const TriangleMesh& from, const Eigen::Isometry3d& motion, const TriangleMesh& to) {
  const ClosestPointQuery query(to.vertices, to.triangles);
  double sum = 0.0;
  for (const SurfaceSample& sample : sampleSurface(from, kComparedPlaces, 1)) {
    const Eigen::Vector3d place = motion * sample.position;
    sum += (query.closest(place).position - place).norm();
  }
  return sum / static_cast<double>(kComparedPlaces);
}

}  // namespace

bool isSameMesh(const SurfaceRecord& result, const SurfaceRecord& truth) {
  return sameMesh(result.topologies.begin()->second, truth.topologies.begin()->second);
}

std::optional<AlikePoses> mapOtherMesh(const std::string& bag, const std::vector<StatusRecord>& statuses,
                                       const SurfaceRecord& truth, SurfaceRecord* result) {
  const MeshTopology& mesh = result->topologies.begin()->second;
  const MeshTopology& true_mesh = truth.topologies.begin()->second;
  const Model model = restModel(bag + ": its mesh", mesh), true_model = restModel("the true mesh", true_mesh);
  const Eigen::Isometry3d fitted = fitModel(model, true_model);
  const Eigen::Isometry3d taken =
      motionTaken(statuses, truth, *result).value_or(fitted) * fitted.inverse();  // of the true mesh
  const SelfMap map = nearestSelfMap(true_model.mesh, taken);
  const bool same_shape = isSymmetry(map, true_model.mesh);
  const Eigen::Isometry3d motion = same_shape ? map.motion * fitted : fitted;
  const double distance = std::max(meanDistance(model.mesh, motion, true_model.mesh),
                                   meanDistance(true_model.mesh, motion.inverse(), model.mesh));
  if (distance > kOtherBody * diagonalOf(true_model.mesh)) {
    throw std::invalid_argument(
        fmt::format("{}: its mesh is not of the body of the truth: laid onto each other at rest, their "
                    "surfaces are {:.3g} mm apart (mean); give the truth of this body",
                    bag, 1e3 * distance));
  }
  result->material = {materialMap(motion, mesh, true_mesh)};
  result->notes.push_back(fmt::format(
      "the mesh is not that of the truth: at rest, their surfaces are {:.3f} mm apart (mean), and "
      "each vertex is compared with the nearest place of the true one",
      1e3 * distance));
  int poses = 1;
  for (const StatusRecord& status : statuses) poses = std::max(poses, status.alike);
  if (poses < 2) return std::nullopt;
  const Eigen::Isometry3d& turn = same_shape ? map.motion : taken;
  return AlikePoses{poses, true, same_shape, Eigen::AngleAxisd(turn.linear()).angle()};
}

}  // namespace softbody::evaluation
