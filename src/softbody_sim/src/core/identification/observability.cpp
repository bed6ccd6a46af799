#include "identification/observability.h"

#include <fmt/format.h>

#include <cmath>

#include "softbody_common/geometry/rigid_fit.h"
#include "softbody_common/geometry/tet_geometry.h"

namespace softbody {

/// The rigid body has no unknowns, so the fit must be better by more than its unknowns fit noise: twice the
/// standard deviation of each, which is a fall of four in the sum of squares.
SeenDeformation deformationOf(const MaterialProblem& problem, const MaterialFit& fit, double factor) {
  const Prediction& simulated = fit.state().prediction;
  Prediction rigid = simulated;
  Eigen::Index first = 0;
  double squares = 0.0;
  for (const ShapeObservation& observation : problem.observations) {
    const auto count = static_cast<Eigen::Index>(observation.targets.size());
    if (count == 0) continue;
    Points rest(count, 3);
    for (Eigen::Index k = 0; k < count; ++k)
      rest.row(k) = positionOf(observation.targets[static_cast<std::size_t>(k)].place,
                               problem.topology.rest_vertices, problem.topology.tets)
                        .transpose();
    auto places = rigid.places.middleRows(first, count);
    places = transformed(rest, fitRigid(rest, places));
    squares += (places - simulated.places.middleRows(first, count)).squaredNorm();
    first += count;
  }
  SeenDeformation seen;
  if (first == 0) return seen;
  seen.rms_m = std::sqrt(squares / static_cast<double>(first));
  const double fall =
      fit.misfit(fit.residuals().at(rigid, fit.state().alignment)) - fit.misfit(fit.state().residuals);
  seen.is_shown = fall > 4.0 * factor * static_cast<double>(fit.unknowns().size());
  return seen;
}

std::string whyWithoutScale(const MaterialProblem& problem) {
  const Scale scale = scaleOf(problem);
  if (scale.is_known()) return "";
  if (scale.has_gravity || problem.moves)
    return "the mass is not known, so only Young's modulus over the density shows: give the mass, or add a "
           "known "
           "weight or force";
  return "there is no weight, inertia or force in the data: add a known weight or force, or give gravity and "
         "the "
         "mass";
}

std::string whyUncertain(const Unknown& unknown, double error, const SeenDeformation& deformation) {
  if (!deformation.is_shown)
    return fmt::format(
        "nothing deforms: the body is {:.2g} mm from its rest shape, which is within the noise; load it "
        "until it "
        "bends visibly",
        1e3 * deformation.rms_m);
  switch (unknown.property) {
    case Property::kYoungsModulus:
      return fmt::format(
          "the data give it only to a factor of {:.2g}: load the body so that it deforms more{}",
          std::exp(std::min(error, 20.0)), unknown.kind > 0 ? " in this region" : "");
    case Property::kPoissonRatio:
      return fmt::format("the data give it only to {:.2g}: press or pull the body so that its sides move",
                         error);
    case Property::kDamping:
      return fmt::format("the data give it only to {:.2g}: let the body swing freely", error);
    case Property::kDensity:
      break;
  }
  return "";
}

}  // namespace softbody
