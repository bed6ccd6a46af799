#pragma once

namespace softbody {

/// A value times Cauchy's weight of a residual. @param square of the residual, in units of the scale at which
/// half of the weight is lost.
template <typename T>
T cauchyWeighted(const T& value, double square) {
  return value / (1.0 + square);
}

}  // namespace softbody
