#include "softbody_sim/identification/material_problem.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace softbody {
namespace {

[[noreturn]] void refuse(std::size_t observation, const std::string& why) {
  throw std::invalid_argument(fmt::format("observation {}: {}", observation + 1, why));
}

void requireUsableTargets(std::size_t k, const ShapeObservation& observation, Eigen::Index tets) {
  if (!observation.images.empty() && observation.images.size() != observation.targets.size())
    refuse(k, fmt::format("there are {} images for {} targets", observation.images.size(),
                          observation.targets.size()));
  for (const Target& target : observation.targets) {
    const bool is_finite =
        target.position.allFinite() && target.normal.allFinite() && target.place.barycentric.allFinite();
    if (!is_finite || !(target.weight > 0.0) || target.place.tet < 0 || target.place.tet >= tets)
      refuse(k, "a target is not finite, has no weight, or names a tet that does not exist");
  }
}

void requireUsableWrenches(std::size_t k, const ShapeObservation& observation) {
  for (const MeasuredWrench& wrench : observation.wrenches) {
    if (!wrench.value.force.allFinite() || !wrench.value.torque.allFinite())
      refuse(k, "a wrench is not finite");
    if (!(wrench.force_std_n > 0.0)) refuse(k, "a wrench has no standard deviation above 0");
    if (wrench.obstacle >= static_cast<int>(observation.surroundings.obstacles.size()))
      refuse(k, fmt::format("a wrench was measured at obstacle {}, which does not exist", wrench.obstacle));
    if (wrench.obstacle < 0 && wrench.vertices.empty())
      refuse(k, "a wrench was measured neither at pins nor at an obstacle");
    if (!std::is_sorted(wrench.vertices.begin(), wrench.vertices.end()))
      refuse(k, "the vertices of a wrench are not ascending");
  }
}

}  // namespace

void requireUsable(const MaterialProblem& problem) {
  requireUsable(problem.prior);
  if (problem.observations.empty())
    throw std::invalid_argument("there is no observation, so nothing is known of the material");
  if (!(problem.mass_std >= 0.0))
    throw std::invalid_argument("the standard deviation of the mass is negative");
  std::size_t measured = 0;
  for (std::size_t k = 0; k < problem.observations.size(); ++k) {
    const ShapeObservation& observation = problem.observations[k];
    if (k > 0 && observation.stamp < problem.observations[k - 1].stamp)
      refuse(k, "its stamp is before that of the observation before it");
    requireUsableTargets(k, observation, problem.topology.tets.rows());
    requireUsable(observation.surroundings, problem.topology.rest_vertices.rows());
    requireUsableWrenches(k, observation);
    measured += observation.targets.size() + observation.wrenches.size();
  }
  if (measured == 0)
    throw std::invalid_argument(
        "no observation has a target or a wrench, so nothing is known of the material");
}

}  // namespace softbody
