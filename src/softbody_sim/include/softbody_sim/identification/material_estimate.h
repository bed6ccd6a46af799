#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <string>
#include <vector>

#include "softbody_sim/identification/material_problem.h"

namespace softbody {

/// One property that was to be found. Standard errors of Young's modulus are in pascals.
struct EstimatedProperty {
  std::string name;          ///< as in the object YAML, e.g. youngs_modulus_pa or materials/0/poisson_ratio
  double value = 0.0;        ///< found; the prior's if it is not observable
  double statistical = 0.0;  ///< standard error from the measurements
  double mesh = 0.0;         ///< standard error from the stiffness of the mesh
  double correlation_factor = 1.0;  ///< of the variance: errors of neighbours are not independent
  bool observable = false;
  std::string why;  ///< it is not observable, and what to add; or what to know of the value

  double standardError() const;  ///< statistical and of the mesh together
};

/// How an observation is explained.
struct ObservationFit {
  Nanoseconds stamp = 0;
  double rms_before_m = 0.0;  ///< of the targets, with the prior
  double rms_after_m = 0.0;
  std::vector<Wrench> wrenches;  ///< simulated, about the measured ones' origins
};

struct MaterialEstimate {
  Material material;  ///< the prior with what is observable, also the deviation of Young's modulus
  std::vector<EstimatedProperty> properties;
  Eigen::MatrixXd correlation;        ///< of the properties, by their statistical errors
  double modulus_over_density = 0.0;  ///< [m^2/s^2], if gravity shows it; else 0
  /// Young's modulus with each tet split into eight, and its standard error. It is nearer to that of the
  /// material. 0: not observable.
  double refined_modulus_pa = 0.0, refined_std_pa = 0.0;
  Eigen::Isometry3d alignment = Eigen::Isometry3d::Identity();  ///< of the simulated body to the targets
  std::vector<ObservationFit> observations;
  std::vector<Points> shapes;  ///< per observation: the simulated vertices, aligned [m]
  double deformation_m = 0.0;  ///< rms of the simulated places, from the rigid body
  std::string sentence;        ///< what was found, or why nothing was
};

/// Finds the material with which the simulator explains the observations: least squares with finite
/// differences (Levenberg-Marquardt) and robust weights. The standard errors include correlated errors of the
/// measurements, estimated from the residuals, and the error of the mesh, estimated on the refined mesh.
/// @param progress is called with the finished fraction, 0..1.
/// @throw std::invalid_argument as requireUsable does; std::runtime_error if the prior has no equilibrium.
MaterialEstimate identifyMaterial(
    const MaterialProblem& problem, const std::function<void(double)>& progress = [](double) {});

/// The whole estimate as text: values with their errors, correlations, and how each observation is explained.
std::string reportOf(const MaterialEstimate& estimate);

}  // namespace softbody
