#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace softbody {

/// Median of the absolute values of a standard normal distribution.
constexpr double kMedianPerSigma = 0.6745;

/// Of two middle values the larger; 0 for none. Reorders the values.
inline double median(std::vector<double>* values) {
  if (values->empty()) return 0.0;
  const auto middle = values->begin() + static_cast<std::ptrdiff_t>(values->size() / 2);
  std::nth_element(values->begin(), middle, values->end());
  return *middle;
}

}  // namespace softbody
