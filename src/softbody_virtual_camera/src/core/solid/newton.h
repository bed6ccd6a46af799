#pragma once

#include "solid/hex_solid.h"

namespace softbody::virtual_camera {

constexpr double kBalance_n = 1e-6;  ///< forces that are not balanced, together [N]

/// A function whose least value is searched.
class Objective {
 public:
  virtual ~Objective() = default;
  virtual double value(const Eigen::VectorXd& unknowns) const = 0;
  virtual Eigen::VectorXd gradient(const Eigen::VectorXd& unknowns) const = 0;
  /// The lower triangle of the second derivative. @param positive as positive as its parts can be made.
  virtual Triplets curvature(const Eigen::VectorXd& unknowns, bool positive) const = 0;
};

/// Newton's method with a line search, from a start to a stationary point where the gradient is shorter than
/// the tolerance.
/// @param fixed unknowns that keep their start value.
/// @throw std::runtime_error if it does not converge.
Eigen::VectorXd minimized(const Objective& objective, Eigen::VectorXd start, const std::vector<bool>& fixed,
                          double tolerance);

}  // namespace softbody::virtual_camera
