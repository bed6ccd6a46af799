#pragma once

#include <cstddef>
#include <vector>

namespace softbody::evaluation {

/// Of a sample of non-negative numbers; all zero if it is empty.
struct Summary {
  std::size_t count = 0;
  double mean = 0.0, rms = 0.0, median = 0.0, p95 = 0.0, max = 0.0;
};

/// Percentiles are the smallest value that at least that share of the sample does not exceed.
Summary summarize(std::vector<float> values);

/// Share of the values that are at most `limit`, 0..1; 0 if there are none.
double shareWithin(const std::vector<float>& values, double limit);

/// Slope of a least-squares line through (x, y); 0 for fewer than two different x.
double slope(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace softbody::evaluation
