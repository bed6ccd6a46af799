#include "identification/estimate_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "softbody_common/time/time.h"

namespace softbody {
namespace {

bool hasUnit(const EstimatedProperty& property) {
  return property.name.find("youngs_modulus_pa") != std::string::npos;
}

std::string valueText(const EstimatedProperty& property) {
  return hasUnit(property) ? fmt::format("{:.4g} Pa", property.value) : fmt::format("{:.4g}", property.value);
}

std::string lineOf(const EstimatedProperty& property) {
  if (property.name == "mass")
    return fmt::format("mass: {:.4g} times the given one, with a standard error of {:.2g}\n", property.value,
                       property.standardError());
  if (!property.observable)
    return fmt::format(
        "{}: not observable: {}; it stays {} (standard error {:.2g} from the measurements, {:.2g} from the "
        "mesh)\n",
        property.name, property.why, valueText(property), property.statistical, property.mesh);
  const double percent = 100.0 * property.standardError() / std::max(std::abs(property.value), 1e-300);
  return fmt::format(
      "{}: {} with a standard error of {:.2g} ({:.2g} %): {:.2g} from the measurements, {:.2g} from "
      "the mesh; the variance is {:.2g} times that of independent errors\n",
      property.name, valueText(property), property.standardError(), percent, property.statistical,
      property.mesh, property.correlation_factor);
}

std::string observationsText(const MaterialEstimate& estimate) {
  constexpr std::size_t kMost = 12;  // lines of a report that is read
  std::string text;
  const std::size_t step = 1 + (estimate.observations.size() - 1) / kMost;
  const Nanoseconds first = estimate.observations.front().stamp;
  for (std::size_t k = 0; k < estimate.observations.size(); k += step) {
    const ObservationFit& fit = estimate.observations[k];
    text += fmt::format(
        "observation {} at {:.2f} s: residual {:.3g} mm with the material of the object, {:.3g} mm "
        "with the found one",
        k + 1, seconds(fit.stamp - first), 1e3 * fit.rms_before_m, 1e3 * fit.rms_after_m);
    for (const Wrench& wrench : fit.wrenches) text += fmt::format("; force {:.3g} N", wrench.force.norm());
    text += '\n';
  }
  return text;
}

}  // namespace

std::string sentenceOf(const MaterialEstimate& estimate) {
  std::string found, missing;
  for (const EstimatedProperty& property : estimate.properties) {
    if (property.name == "mass") continue;
    if (property.observable)
      found += fmt::format("{}{} is {} +- {:.2g}", found.empty() ? "" : ", ", property.name,
                           valueText(property), property.standardError());
    else
      missing +=
          fmt::format("{}{} is not observable: {}", missing.empty() ? "" : "; ", property.name, property.why);
  }
  if (estimate.modulus_over_density > 0.0)
    missing +=
        fmt::format(". Young's modulus over the density is {:.4g} m^2/s^2", estimate.modulus_over_density);
  return found + (found.empty() || missing.empty() ? "" : "; ") + missing;
}

std::string reportOf(const MaterialEstimate& estimate) {
  std::string text = estimate.sentence + "\n\n";
  for (const EstimatedProperty& property : estimate.properties) text += lineOf(property);
  if (estimate.properties.size() > 1) {
    for (std::size_t a = 0; a < estimate.properties.size(); ++a)
      for (std::size_t b = 0; b < a; ++b)
        if (const auto i = static_cast<Eigen::Index>(a), j = static_cast<Eigen::Index>(b);
            i < estimate.correlation.rows())
          text += fmt::format("correlation of {} and {}: {:.2f}\n", estimate.properties[b].name,
                              estimate.properties[a].name, estimate.correlation(i, j));
  }
  if (estimate.material.youngs_modulus_std_pa)
    text += fmt::format(
        "These values are for this mesh: with them it deforms as the body. With a finer mesh, Young's "
        "modulus "
        "is {:.4g} Pa with a standard error of {:.2g}\n",
        estimate.refined_modulus_pa, estimate.refined_std_pa);
  text += fmt::format("The body deforms by {:.2g} mm (rms of the measured places)\n",
                      1e3 * estimate.deformation_m);
  return text + observationsText(estimate);
}

}  // namespace softbody
