#pragma once

#include <cstddef>
#include <limits>
#include <vector>

namespace softbody::evaluation {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

/// Of a sample of non-negative numbers; all but the count NaN if it is empty: nothing measured is not zero
/// error.
struct Summary {
  std::size_t count = 0;
  double mean = kNothing, rms = kNothing, median = kNothing, p95 = kNothing, max = kNothing;
};

/// Percentiles are the smallest value that at least that share of the sample does not exceed.
Summary summarize(std::vector<float> values);

/// Share of the values that are at most `limit`, 0..1; NaN if there are none.
double shareWithin(const std::vector<float>& values, double limit);

/// Slope of a least-squares line through (x, y); 0 for fewer than two different x.
double slope(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace softbody::evaluation
