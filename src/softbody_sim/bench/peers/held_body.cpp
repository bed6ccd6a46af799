#include "bench/peers/held_body.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "identification/tet_refinement.h"
#include "softbody_sim/dynamics/simulator.h"

namespace softbody::bench {
namespace {

constexpr double kFree = 0.75;  ///< share of the half length that no hand holds

/// The section of a body at `along` from the middle, moved rigidly to an axis that is bent about y.
/// @param place relative to the middle of the body [m]. @param along, signed [m].
Eigen::RowVector3d moved(const Eigen::RowVector3d& place, double along, double curvature) {
  const double angle = curvature * along, beyond = place.x() - along;
  const Eigen::RowVector3d axis(std::sin(angle) / curvature, 0.0, (1.0 - std::cos(angle)) / curvature);
  return axis + Eigen::RowVector3d(std::cos(angle) * beyond - std::sin(angle) * place.z(), place.y(),
                                   std::sin(angle) * beyond + std::cos(angle) * place.z());
}

/// Pins of the vertices that the hands hold. @param centered rest vertices around the middle.
std::vector<Pin> hands(const Points& centered, double half_length, double curvature) {
  std::vector<Pin> pins;
  for (int v = 0; v < static_cast<int>(centered.rows()); ++v) {
    const double x = centered(v, 0);
    if (std::abs(x) < kFree * half_length) continue;
    const double along = std::copysign(kFree * half_length, x);
    pins.push_back({v, moved(centered.row(v), along, curvature).transpose()});
  }
  return pins;
}

SimulatorConfig finiteElements() {
  SimulatorConfig config;
  config.solver = SolverKind::kFem;
  config.elasticity = Elasticity::kNeoHookean;
  config.iterations = 200;
  config.strain_smoothing = config.load_fade_s = config.memory_s = 0.0;
  config.volume_smoothing = 0.0;
  return config;
}

}  // namespace

std::vector<Points> heldShapes(const TetTopology& body, double curvature, int frames) {
  const TetTopology fine = refine(body).topology;
  Eigen::RowVector3d middle = body.rest_vertices.colwise().mean();
  middle.y() = 0.0;
  const Points centered = fine.rest_vertices.rowwise() - middle;
  const double half_length = std::min(centered.col(0).maxCoeff(), -centered.col(0).minCoeff());
  Simulator simulator(fine, Material(), finiteElements());
  TargetSet placing;
  placing.reset = true;
  placing.body_pose.translation() = -middle.transpose();
  std::vector<Points> shapes;
  for (int frame = 0; frame < frames; ++frame) {
    const double share = static_cast<double>(frame + 1) / frames;
    Surroundings surroundings;
    surroundings.pins = hands(centered, half_length, curvature * share * share * (3.0 - 2.0 * share));
    simulator.settle(placing, surroundings);
    placing.reset = false;
    if (!simulator.report().converged)
      throw std::runtime_error(fmt::format("frame {} of the held body finds no balance", frame));
    shapes.push_back(simulator.state().vertices.topRows(body.rest_vertices.rows()));
  }
  return shapes;
}

}  // namespace softbody::bench
