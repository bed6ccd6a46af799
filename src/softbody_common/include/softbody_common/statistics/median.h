#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace softbody {

/// Median of the absolute values of a standard normal distribution.
constexpr double kMedianPerSigma = 0.6745;

/// Of two middle values the larger; 0 for none. Reorders the values.
template <typename T>
T median(std::vector<T>* values) {
  if (values->empty()) return T{0};
  const auto middle = values->begin() + static_cast<std::ptrdiff_t>(values->size() / 2);
  std::nth_element(values->begin(), middle, values->end());
  return *middle;
}

/// The same of values that stay.
template <typename T>
T medianOf(std::vector<T> values) {
  return median(&values);
}

}  // namespace softbody
