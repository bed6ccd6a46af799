#include "softbody_evaluation/measures/statistics.h"

#include <algorithm>
#include <cmath>

namespace softbody::evaluation {
namespace {

/// @param sorted not empty.
double percentile(const std::vector<float>& sorted, double share) {
  const double rank = std::ceil(share * static_cast<double>(sorted.size()));
  return sorted[static_cast<std::size_t>(std::max(1.0, rank)) - 1];
}

}  // namespace

Summary summarize(std::vector<float> values) {
  Summary summary;
  if (values.empty()) return summary;
  std::sort(values.begin(), values.end());
  double sum = 0.0, squares = 0.0;
  for (const double value : values) {
    sum += value;
    squares += value * value;
  }
  summary.count = values.size();
  summary.mean = sum / static_cast<double>(values.size());
  summary.rms = std::sqrt(squares / static_cast<double>(values.size()));
  summary.median = percentile(values, 0.5);
  summary.p95 = percentile(values, 0.95);
  summary.p99 = percentile(values, 0.99);
  summary.max = values.back();
  return summary;
}

double shareWithin(const std::vector<float>& values, double limit) {
  if (values.empty()) return kNothing;
  const auto within =
      std::count_if(values.begin(), values.end(), [limit](float value) { return value <= limit; });
  return static_cast<double>(within) / static_cast<double>(values.size());
}

double slope(const std::vector<double>& x, const std::vector<double>& y) {
  double mean_x = 0.0, mean_y = 0.0, covariance = 0.0, variance = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    mean_x += x[i] / static_cast<double>(x.size());
    mean_y += y[i] / static_cast<double>(x.size());
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    covariance += (x[i] - mean_x) * (y[i] - mean_y);
    variance += (x[i] - mean_x) * (x[i] - mean_x);
  }
  return variance > 0.0 ? covariance / variance : 0.0;
}

}  // namespace softbody::evaluation
