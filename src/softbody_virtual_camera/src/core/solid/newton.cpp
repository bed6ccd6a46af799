#include "solid/newton.h"

#include <fmt/format.h>

#include <Eigen/SparseCholesky>
#include <stdexcept>

namespace softbody::virtual_camera {
namespace {

constexpr int kMostSteps = 100, kMostHalvings = 40;

using Factor = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>;

/// The Newton step of the free unknowns; none if the second derivative is not positive.
bool findStep(const Triplets& curvature, const Eigen::VectorXd& gradient, const std::vector<bool>& fixed,
              Factor* factor, Eigen::VectorXd* step) {
  Triplets rows;
  rows.reserve(curvature.size() + fixed.size());
  for (const auto& entry : curvature) {
    if (!fixed[static_cast<std::size_t>(entry.row())] && !fixed[static_cast<std::size_t>(entry.col())])
      rows.push_back(entry);
  }
  for (std::size_t i = 0; i < fixed.size(); ++i) {
    if (fixed[i]) rows.emplace_back(static_cast<int>(i), static_cast<int>(i), 1.0);
  }
  Eigen::SparseMatrix<double> matrix(gradient.size(), gradient.size());
  matrix.setFromTriplets(rows.begin(), rows.end());
  factor->compute(matrix);
  if (factor->info() != Eigen::Success || !(factor->vectorD().minCoeff() > 0.0)) return false;
  *step = -factor->solve(gradient);
  return true;
}

}  // namespace

Eigen::VectorXd minimized(const Objective& objective, Eigen::VectorXd unknowns,
                          const std::vector<bool>& fixed, double tolerance) {
  constexpr double kSufficient = 1e-4;
  Factor factor;
  for (int count = 0; count < kMostSteps; ++count) {
    Eigen::VectorXd gradient = objective.gradient(unknowns), step;
    for (std::size_t i = 0; i < fixed.size(); ++i) {
      if (fixed[i]) gradient[static_cast<Eigen::Index>(i)] = 0.0;
    }
    if (gradient.norm() < tolerance) return unknowns;
    if (!findStep(objective.curvature(unknowns, false), gradient, fixed, &factor, &step) &&
        !findStep(objective.curvature(unknowns, true), gradient, fixed, &factor, &step)) {
      throw std::runtime_error("the solid of this scene is not held");
    }
    const double value = objective.value(unknowns), slope = gradient.dot(step);
    double length = 1.0;
    for (int k = 0; k < kMostHalvings; ++k, length *= 0.5) {
      if (objective.value(unknowns + length * step) <= value + kSufficient * length * slope + 1e-14) break;
    }
    unknowns += length * step;
  }
  throw std::runtime_error(
      fmt::format("the solid of this scene is not in balance after {} steps", kMostSteps));
}

}  // namespace softbody::virtual_camera
