#include "outline/contour_posterior.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace softbody {
namespace {

// The pixels are not independent: a lens and a debayering filter blur them over about two pixels.
constexpr double kIndependentShare = 0.5;
// Candidates of the end between two pixels.
constexpr int kPerPixel = 4;
// Largest probability of an end at the border of the line, relative to the most probable end: the true end
// may lie beyond.
constexpr double kLargestAtBorder = 0.05;
// Smallest variance [px^2]: the outline is sampled at the centres of pixels, a uniform error of one pixel.
constexpr double kSmallestVariance = 1.0 / 12.0;
// Standard deviation of a mesh's outline from the body's [px], and the largest motion in usual errors.
constexpr double kModelDeviation = 0.7, kSudden = 3.0;
// Precision that a line adds, below which it adds nothing, in shares of that of the prediction: rounding.
constexpr double kLeastPrecision = 1e-3;

/// The logarithm of the likelihood of an end at the predicted outline. @param ends in the order of the line.
double logLikelihoodAtOutline(const std::vector<LinePixel>& ends) {
  const auto after =
      std::lower_bound(ends.begin(), ends.end(), 0.0,
                       [](const LinePixel& end, double distance) { return end.distance < distance; });
  if (after == ends.begin()) return ends.front().log_odds;
  if (after == ends.end()) return ends.back().log_odds;
  const LinePixel& before = *(after - 1);
  const double share = -before.distance / (after->distance - before.distance);
  return before.log_odds + share * (after->log_odds - before.log_odds);
}

/// The logarithms of the likelihood of ends on a line, up to a constant.
void integrate(const std::vector<LinePixel>& line, std::vector<LinePixel>* ends) {
  ends->assign(1, {line.front().distance, 0.0});
  for (std::size_t i = 1; i < line.size(); ++i) {
    const double length = line[i].distance - line[i - 1].distance;
    const double from = line[i - 1].log_odds, slope = line[i].log_odds - from;
    const double start = ends->back().log_odds;
    for (int k = 1; k <= kPerPixel; ++k) {
      const double t = static_cast<double>(k) / kPerPixel;
      const double integral = start + kIndependentShare * length * t * (from + 0.5 * t * slope);
      ends->push_back({line[i - 1].distance + t * length, integral});
    }
  }
}

/// Weighted sums of distances.
struct Moments {
  double sum = 0.0, first = 0.0, second = 0.0;

  void add(double weight, double distance) {
    sum += weight;
    first += weight * distance;
    second += weight * distance * distance;
  }
  ContourEnd end() const {
    const double mean = first / sum;
    return {mean, second / sum - mean * mean};
  }
};

/// @param together line and prediction. @param prediction the same ends without evidence: the line is finite.
ContourEnd added(const ContourEnd& together, const ContourEnd& prediction) {
  const double precision = 1.0 / together.variance - 1.0 / prediction.variance;
  if (!(precision > kLeastPrecision / prediction.variance))
    return {0.0, std::numeric_limits<double>::infinity()};
  const double mean = (together.mean / together.variance - prediction.mean / prediction.variance) / precision;
  return {mean, 1.0 / precision + kSmallestVariance};
}

}  // namespace

double predictionVariance(double error_px) {
  if (error_px == 0.0) return std::numeric_limits<double>::infinity();
  return kModelDeviation * kModelDeviation + kSudden * kSudden * error_px * error_px;
}

ContourPosterior contourPosterior(const std::vector<LinePixel>& line, double prediction_variance) {
  thread_local std::vector<LinePixel> ends;
  integrate(line, &ends);
  double largest = 0.0;
  for (const LinePixel& end : ends) largest = std::max(largest, end.log_odds);
  Moments alone, predicted, together;
  for (const LinePixel& end : ends) {
    const double likelihood = std::exp(end.log_odds - largest);
    alone.add(likelihood, end.distance);
    const double prior = std::exp(-0.5 * end.distance * end.distance / prediction_variance);
    together.add(likelihood * prior, end.distance);
    predicted.add(prior, end.distance);
  }
  ContourPosterior result;
  result.end = alone.end();
  result.end.variance += kSmallestVariance;
  result.together = together.end().mean;
  result.added = added(together.end(), predicted.end());
  const double at_border = std::exp(std::max(ends.front().log_odds, ends.back().log_odds) - largest);
  result.doubt = std::sqrt(2.0 * std::max(0.0, largest - logLikelihoodAtOutline(ends)));
  result.beyond = at_border > kLargestAtBorder;
  return result;
}

}  // namespace softbody
