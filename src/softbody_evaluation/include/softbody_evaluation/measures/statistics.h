#pragma once

#include <cstddef>
#include <limits>
#include <vector>

namespace softbody::evaluation {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

/// Statistics of non-negative numbers. All values but the count are NaN if there are no numbers, because no
/// measurement does not mean zero error.
struct Summary {
  std::size_t count = 0;
  double mean = kNothing, rms = kNothing, median = kNothing, p95 = kNothing, p99 = kNothing, max = kNothing;
};

/// Summarises values. A percentile is the smallest value that at least this share of the values does not
/// exceed.
Summary summarize(std::vector<float> values);

/// Share of the values up to `limit`, 0..1; NaN without values.
double shareWithin(const std::vector<float>& values, double limit);

/// Slope of the least-squares line through (x, y); 0 with fewer than two different x.
double slope(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace softbody::evaluation
