#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "softbody_sim/identification/material_problem.h"

namespace softbody {

enum class Property { kYoungsModulus, kPoissonRatio, kDamping, kDensity };

/// A number that the search changes: log E, nu, the damping, or the logarithm of a factor of all densities.
struct Unknown {
  Property property = Property::kYoungsModulus;
  int kind = 0;  ///< 0: the body; k: region k - 1 of its material

  std::string name() const;  ///< as in the object YAML
};

/// What gives the scale of the stiffness.
struct Scale {
  bool has_force = false;  ///< a measured wrench, or a known load
  bool has_mass = false;   ///< weight or inertia of a known mass
  bool has_gravity = false;

  bool is_known() const { return has_force || has_mass; }
};

Scale scaleOf(const MaterialProblem& problem);

/// The unknowns of a problem that the data may show. Without a scale, Young's modulus of the body is not one
/// of them; those of its regions are, relative to it. The mass is one if it is not known exactly and forces
/// or weights can show it.
std::vector<Unknown> unknownsOf(const MaterialProblem& problem);

/// The material for given values of the unknowns, within the allowed ranges.
Material materialWith(const Material& prior, const std::vector<Unknown>& unknowns,
                      const Eigen::VectorXd& values);

/// The unknowns' values of a material. The factor of the densities is 1.
Eigen::VectorXd valuesOf(const Material& material, const std::vector<Unknown>& unknowns);

/// Values moved into the allowed ranges.
Eigen::VectorXd withinRange(const std::vector<Unknown>& unknowns, Eigen::VectorXd values);

/// The value as a user reads it: E in pascals, others as they are; and what an error becomes there.
double shownValue(const Unknown& unknown, double value);
double shownError(const Unknown& unknown, double value, double error);

/// The standard deviation from which an unknown counts as not observable: a third in log E; for others that
/// of a guess anywhere in the allowed range.
double largestError(const Unknown& unknown);

}  // namespace softbody
