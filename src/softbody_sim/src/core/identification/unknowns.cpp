#include "identification/unknowns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace softbody {
namespace {

/// Of a region, or of the body: its values as one.
double& valueIn(Material* material, const Unknown& unknown) {
  if (unknown.property == Property::kDamping) return material->damping;
  if (unknown.kind == 0)
    return unknown.property == Property::kYoungsModulus ? material->youngs_modulus_pa
                                                        : material->poisson_ratio;
  MaterialRegion& region = material->regions[static_cast<std::size_t>(unknown.kind) - 1];
  return unknown.property == Property::kYoungsModulus ? region.youngs_modulus_pa : region.poisson_ratio;
}

/// Of the value that is searched.
MaterialRange rangeOf(const Unknown& unknown) {
  switch (unknown.property) {
    case Property::kYoungsModulus:
      return {std::log(kYoungsModulusRange.min), std::log(kYoungsModulusRange.max)};
    case Property::kPoissonRatio:
      return kPoissonRatioRange;
    case Property::kDamping:
      return kDampingRange;
    case Property::kDensity:
      break;
  }
  return {-std::log(100.0), std::log(100.0)};  // a mass that is wrong by more is a wrong unit
}

void scaleDensities(double factor, Material* material) {
  const auto scale = [factor](double* density) {
    *density = std::clamp(factor * *density, kDensityRange.min, kDensityRange.max);
  };
  scale(&material->density_kg_m3);
  for (MaterialRegion& region : material->regions) scale(&region.density_kg_m3);
}

}  // namespace

std::string Unknown::name() const {
  const std::string region = kind == 0 ? "" : fmt::format("materials/{}/", kind - 1);
  switch (property) {
    case Property::kYoungsModulus:
      return region + "youngs_modulus_pa";
    case Property::kPoissonRatio:
      return region + "poisson_ratio";
    case Property::kDamping:
      return "damping";
    case Property::kDensity:
      break;
  }
  return "mass";
}

Scale scaleOf(const MaterialProblem& problem) {
  Scale scale;
  scale.has_gravity = !problem.simulator.gravity.isZero(0.0);
  scale.has_mass = std::isfinite(problem.mass_std) && (scale.has_gravity || problem.moves);
  for (const ShapeObservation& observation : problem.observations)
    scale.has_force =
        scale.has_force || !observation.wrenches.empty() ||
        (observation.surroundings.loads.size() > 0 && !observation.surroundings.loads.isZero(0.0));
  return scale;
}

std::vector<Unknown> unknownsOf(const MaterialProblem& problem) {
  const Scale scale = scaleOf(problem);
  std::vector<Unknown> unknowns;
  const int kinds = 1 + static_cast<int>(problem.prior.regions.size());
  // Without a scale, E over the density still shows, and so do the regions relative to the body.
  const bool is_relative = !scale.is_known() && !scale.has_gravity && !problem.moves;
  for (int kind = 0; kind < kinds; ++kind) {
    if (problem.free.youngs_modulus && !(is_relative && kind == 0))
      unknowns.push_back({Property::kYoungsModulus, kind});
    if (problem.free.poisson_ratio) unknowns.push_back({Property::kPoissonRatio, kind});
  }
  if (problem.free.damping && problem.moves) unknowns.push_back({Property::kDamping, 0});
  const bool weighs = scale.has_gravity || problem.moves;
  const bool is_shown = std::isfinite(problem.mass_std) ? problem.mass_std > 0.0 : scale.has_force;
  if (weighs && is_shown) unknowns.push_back({Property::kDensity, 0});
  return unknowns;
}

Material materialWith(const Material& prior, const std::vector<Unknown>& unknowns,
                      const Eigen::VectorXd& values) {
  Material material = prior;
  for (std::size_t k = 0; k < unknowns.size(); ++k) {
    const double value = values[static_cast<Eigen::Index>(k)];
    if (unknowns[k].property == Property::kDensity)
      scaleDensities(std::exp(value), &material);
    else
      valueIn(&material, unknowns[k]) = shownValue(unknowns[k], value);
  }
  return material;
}

Eigen::VectorXd valuesOf(const Material& material, const std::vector<Unknown>& unknowns) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(unknowns.size()));
  Material copy = material;
  for (std::size_t k = 0; k < unknowns.size(); ++k) {
    double& value = values[static_cast<Eigen::Index>(k)];
    if (unknowns[k].property == Property::kDensity)
      value = 0.0;
    else
      value = valueIn(&copy, unknowns[k]);
    if (unknowns[k].property == Property::kYoungsModulus) value = std::log(value);
  }
  return values;
}

Eigen::VectorXd withinRange(const std::vector<Unknown>& unknowns, Eigen::VectorXd values) {
  for (std::size_t k = 0; k < unknowns.size(); ++k) {
    const MaterialRange range = rangeOf(unknowns[k]);
    double& value = values[static_cast<Eigen::Index>(k)];
    value = std::clamp(value, range.min, range.max);
  }
  return values;
}

double shownValue(const Unknown& unknown, double value) {
  switch (unknown.property) {
    case Property::kYoungsModulus:
      return std::clamp(std::exp(value), kYoungsModulusRange.min, kYoungsModulusRange.max);
    case Property::kDensity:
      return std::exp(value);
    default:
      return value;
  }
}

double shownError(const Unknown& unknown, double value, double error) {
  const bool is_logarithm =
      unknown.property == Property::kYoungsModulus || unknown.property == Property::kDensity;
  return is_logarithm ? shownValue(unknown, value) * error : error;
}

double largestError(const Unknown& unknown) {
  if (unknown.property == Property::kYoungsModulus || unknown.property == Property::kDensity) return 0.3;
  const MaterialRange range = rangeOf(unknown);
  return (range.max - range.min) / std::sqrt(12.0);
}

}  // namespace softbody
