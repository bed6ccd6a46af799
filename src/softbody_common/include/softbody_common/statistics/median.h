#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace softbody {

/// Standard deviation of normal errors over the median of their absolute values.
constexpr double kMedianToSigma = 1.4826;

/// The median; of an even number the greater of both in the middle. @param values at least one.
inline double medianOf(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace softbody
