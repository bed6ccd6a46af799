#include <algorithm>
#include <cmath>
#include <memory>

#include "identification/error_correlation.h"
#include "identification/estimate_text.h"
#include "identification/material_fit.h"
#include "identification/observability.h"
#include "identification/tet_refinement.h"
#include "softbody_common/geometry/rigid_fit.h"
#include "softbody_sim/identification/material_estimate.h"

namespace softbody {
namespace {

/// Errors of the unknowns, in the units of the search.
struct Errors {
  Eigen::VectorXd statistical, mesh, factors;
  Eigen::VectorXd mesh_shift;  ///< from the values of this mesh to those of the refined one
};

/// An error that falls with the square of the edges, as linear tets' does, is a third of what one refinement
/// took away. Smoothed strains converge faster.
constexpr double kLeftAfterRefinement = 1.0 / 3.0;

/// The values with which the refined mesh gives the places that this mesh gives with the found ones.
Eigen::VectorXd refinedValues(const MaterialProblem& problem, const MaterialFit& fit) {
  constexpr int kRounds = 4;  // a bound: a small shift ends it
  const MaterialProblem fine = refine(problem);
  ForwardModel finer(fine);
  Eigen::VectorXd values = fit.state().values;
  for (int round = 0; round < kRounds; ++round) {
    const Prediction prediction = finer.predict(materialWith(problem.prior, fit.unknowns(), values));
    finer.startAt(prediction);
    const Eigen::VectorXd shift = fit.valuesThatExplain(prediction);
    values = withinRange(fit.unknowns(), values - shift);
    if (shift.size() == 0 || shift.cwiseAbs().maxCoeff() < 1e-3) break;
  }
  return values;
}

Errors errorsOf(const MaterialProblem& problem, const MaterialFit& fit) {
  const auto count = static_cast<Eigen::Index>(fit.unknowns().size());
  Errors errors;
  errors.factors =
      correlationFactors(fit.residuals().places(), fit.jacobian(), fit.weightedResiduals(), fit.covariance())
          .head(count);
  errors.statistical = fit.covariance().diagonal().head(count).cwiseProduct(errors.factors).cwiseSqrt();
  errors.mesh_shift = refinedValues(problem, fit) - fit.state().values;
  errors.mesh = errors.mesh_shift.cwiseAbs();
  return errors;
}

double rmsOf(const MaterialProblem& problem, const FitState& state, std::size_t observation,
             Eigen::Index first) {
  double squares = 0.0, count = 0.0;
  for (const Target& target : problem.observations[observation].targets) {
    const Eigen::Vector3d difference =
        state.alignment * Eigen::Vector3d(state.prediction.places.row(first++)) - target.position;
    const double distance = target.normal.isZero(0.0) ? difference.norm() : target.normal.dot(difference);
    squares += distance * distance;
    count += 1.0;
  }
  return count > 0.0 ? std::sqrt(squares / count) : 0.0;
}

void addObservations(const MaterialProblem& problem, const FitState& before, const FitState& after,
                     MaterialEstimate* estimate) {
  Eigen::Index target = 0, wrench = 0;
  for (std::size_t k = 0; k < problem.observations.size(); ++k) {
    const ShapeObservation& observation = problem.observations[k];
    ObservationFit fit{
        observation.stamp, rmsOf(problem, before, k, target), rmsOf(problem, after, k, target), {}};
    for (std::size_t w = 0; w < observation.wrenches.size(); ++w, wrench += 6)
      fit.wrenches.push_back(
          {after.prediction.wrenches.segment<3>(wrench), after.prediction.wrenches.segment<3>(wrench + 3)});
    target += static_cast<Eigen::Index>(observation.targets.size());
    estimate->observations.push_back(fit);
    estimate->shapes.push_back(transformed(after.prediction.shapes[k], after.alignment));
  }
}

/// The properties that a fit has found, in its order.
std::vector<EstimatedProperty> propertiesOf(const MaterialFit& fit, const Errors& errors,
                                            const SeenDeformation& deformation) {
  std::vector<EstimatedProperty> properties;
  for (std::size_t k = 0; k < fit.unknowns().size(); ++k) {
    const Unknown& unknown = fit.unknowns()[k];
    const auto row = static_cast<Eigen::Index>(k);
    const double value = fit.state().values[row], error = errors.statistical[row];
    EstimatedProperty property;
    property.name = unknown.name();
    property.value = shownValue(unknown, value);
    property.statistical = shownError(unknown, value, errors.statistical[row]);
    property.mesh = shownError(unknown, value, errors.mesh[row]);
    property.correlation_factor = errors.factors[row];
    property.observable = deformation.is_shown && error < largestError(unknown);
    if (!property.observable) property.why = whyUncertain(unknown, error, deformation);
    properties.push_back(property);
  }
  return properties;
}

/// The unknowns that a fit has shown. The mass stays one: it is not asked for.
std::vector<Unknown> shownOf(const MaterialFit& fit, const std::vector<EstimatedProperty>& properties) {
  std::vector<Unknown> shown;
  for (std::size_t k = 0; k < properties.size(); ++k)
    if (properties[k].observable || fit.unknowns()[k].property == Property::kDensity)
      shown.push_back(fit.unknowns()[k]);
  return shown;
}

Eigen::MatrixXd correlationOf(const MaterialFit& fit) {
  const auto count = static_cast<Eigen::Index>(fit.unknowns().size());
  const Eigen::MatrixXd covariance = fit.covariance().topLeftCorner(count, count);
  const Eigen::VectorXd scale = covariance.diagonal().cwiseSqrt().cwiseInverse();
  return scale.asDiagonal() * covariance * scale.asDiagonal();
}

/// Young's modulus of the body shows only over the density.
void takeScaleAway(const MaterialProblem& problem, MaterialEstimate* estimate) {
  const std::string why = whyWithoutScale(problem);
  if (why.empty()) return;
  for (EstimatedProperty& property : estimate->properties) {
    if (property.name.find("youngs_modulus_pa") == std::string::npos) continue;
    const bool is_shown = property.observable;
    property.observable = false;
    property.why = why;
    if (property.name != "youngs_modulus_pa" || !is_shown) continue;
    estimate->modulus_over_density = property.value / problem.prior.density_kg_m3;
  }
  if (estimate->properties.empty() || estimate->properties.front().name != "youngs_modulus_pa") {
    EstimatedProperty modulus;
    modulus.name = "youngs_modulus_pa";
    modulus.value = problem.prior.youngs_modulus_pa;
    modulus.why = why;
    estimate->properties.insert(estimate->properties.begin(), modulus);
  }
}

/// What the second search has found takes the place of what the first one has.
void replaceShown(std::vector<EstimatedProperty> shown, const Material& prior,
                  const std::vector<Unknown>& unknowns, std::vector<EstimatedProperty>* properties) {
  const Eigen::VectorXd values = valuesOf(prior, unknowns);
  for (std::size_t k = 0; k < properties->size(); ++k) {
    EstimatedProperty& property = (*properties)[k];
    const auto found = std::find_if(shown.begin(), shown.end(), [&property](const EstimatedProperty& other) {
      return other.name == property.name;
    });
    if (found != shown.end())
      property = *found;
    else
      property.value = shownValue(unknowns[k], values[static_cast<Eigen::Index>(k)]);
  }
}

void finish(const MaterialProblem& problem, const MaterialFit& fit, const Errors& errors,
            MaterialEstimate* estimate) {
  estimate->material = fit.material();
  for (std::size_t k = 0; k < fit.unknowns().size(); ++k) {
    if (fit.unknowns()[k].property != Property::kYoungsModulus || fit.unknowns()[k].kind != 0) continue;
    const auto row = static_cast<Eigen::Index>(k);
    estimate->refined_modulus_pa = fit.material().youngs_modulus_pa * std::exp(errors.mesh_shift[row]);
    estimate->refined_std_pa = estimate->refined_modulus_pa *
                               std::hypot(errors.statistical[row], kLeftAfterRefinement * errors.mesh[row]);
  }
  estimate->alignment = fit.state().alignment;
  estimate->correlation = correlationOf(fit);
  takeScaleAway(problem, estimate);
  estimate->material.youngs_modulus_std_pa.reset();
  for (const EstimatedProperty& property : estimate->properties) {
    if (property.name != "youngs_modulus_pa") continue;
    if (property.observable)
      estimate->material.youngs_modulus_std_pa =
          std::max(property.standardError(), kYoungsModulusStdRange.min);
    else
      estimate->material.youngs_modulus_pa = problem.prior.youngs_modulus_pa;
  }
  estimate->sentence = sentenceOf(*estimate);
}

}  // namespace

double EstimatedProperty::standardError() const { return std::hypot(statistical, mesh); }

MaterialEstimate identifyMaterial(const MaterialProblem& problem,
                                  const std::function<void(double)>& progress) {
  requireUsable(problem);
  const std::vector<Unknown> unknowns = unknownsOf(problem);
  auto fit = std::make_unique<MaterialFit>(problem, unknowns);
  const FitState before = fit->state();
  fit->run([&progress](double share) { progress(0.8 * share); });
  Errors errors = errorsOf(problem, *fit);
  MaterialEstimate estimate;
  const double factor = errors.factors.size() > 0 ? errors.factors.maxCoeff() : 1.0;
  const SeenDeformation deformation = deformationOf(problem, *fit, factor);
  estimate.deformation_m = deformation.rms_m;
  estimate.properties = propertiesOf(*fit, errors, deformation);
  const std::vector<Unknown> shown = shownOf(*fit, estimate.properties);
  if (shown.size() < unknowns.size()) {
    fit = std::make_unique<MaterialFit>(problem, shown);
    fit->run([&progress](double share) { progress(0.8 + 0.15 * share); });
    errors = errorsOf(problem, *fit);
    replaceShown(propertiesOf(*fit, errors, deformation), problem.prior, unknowns, &estimate.properties);
  }
  addObservations(problem, before, fit->state(), &estimate);
  finish(problem, *fit, errors, &estimate);
  progress(1.0);
  return estimate;
}

}  // namespace softbody
