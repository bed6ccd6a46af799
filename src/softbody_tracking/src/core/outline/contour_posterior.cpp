#include "outline/contour_posterior.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "outline/contour_kernel.h"

namespace softbody {
namespace {

// The pixels are not independent: a lens and a debayering filter blur them over about two pixels.
constexpr double kIndependentShare = 0.5;
// Candidates of the end between two pixels.
constexpr std::size_t kPerPixel = 4;
// Largest probability of an end at the border of the line, relative to the most probable end: the true end
// may lie beyond.
constexpr double kLargestAtBorder = 0.05;
// Smallest variance [px^2]: the outline is sampled at the centres of pixels, a uniform error of one pixel.
constexpr double kSmallestVariance = 1.0 / 12.0;
// Standard deviation of a mesh's outline from the body's [px], and the largest motion in usual errors.
constexpr double kModelDeviation = 0.7, kSudden = 3.0;
// Precision that a line adds, below which it adds nothing, in shares of that of the prediction: rounding.
constexpr double kLeastPrecision = 1e-3;

/// The logarithm of the likelihood of an end at the predicted outline.
double logLikelihoodAtOutline(const EndCandidates& ends) {
  const auto first = ends.distances.begin(), last = first + static_cast<std::ptrdiff_t>(ends.count);
  const auto after = static_cast<std::size_t>(std::lower_bound(first, last, 0.0) - first);
  if (after == 0) return ends.log_odds.front();
  if (after == ends.count) return ends.log_odds[ends.count - 1];
  const std::size_t before = after - 1;
  const double share = -ends.distances[before] / (ends.distances[after] - ends.distances[before]);
  return ends.log_odds[before] + share * (ends.log_odds[after] - ends.log_odds[before]);
}

/// The logarithms of the likelihood of ends on a line, up to a constant.
void integrate(const std::vector<LinePixel>& line, EndCandidates* ends) {
  ends->resize(1 + kPerPixel * (line.size() - 1));
  ends->distances[0] = line.front().distance;
  ends->log_odds[0] = 0.0;
  std::size_t last = 0;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const double length = line[i].distance - line[i - 1].distance;
    const double from = line[i - 1].log_odds, slope = line[i].log_odds - from;
    const double start = ends->log_odds[last];
    for (std::size_t k = 1; k <= kPerPixel; ++k) {
      const double t = static_cast<double>(k) / kPerPixel;
      ++last;
      ends->distances[last] = line[i - 1].distance + t * length;
      ends->log_odds[last] = start + kIndependentShare * length * t * (from + 0.5 * t * slope);
    }
  }
}

ContourEnd endOf(const DistanceSums& sums) {
  const double mean = sums.first / sums.weights;
  return {mean, sums.second / sums.weights - mean * mean};
}

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
  thread_local EndCandidates ends;
  integrate(line, &ends);
  const double* const log_odds = ends.log_odds.data();
  const double largest = *std::max_element(log_odds, log_odds + ends.count);
  const EndSums sums = sumEnds(ends, largest, 1.0 / prediction_variance);
  ContourPosterior result;
  result.end = endOf(sums.alone);
  result.end.variance += kSmallestVariance;
  const ContourEnd together = endOf(sums.together);
  result.together = together.mean;
  result.added = added(together, endOf(sums.predicted));
  const double at_border = std::exp(std::max(log_odds[0], log_odds[ends.count - 1]) - largest);
  result.doubt = std::sqrt(2.0 * std::max(0.0, largest - logLikelihoodAtOutline(ends)));
  result.beyond = at_border > kLargestAtBorder;
  return result;
}

}  // namespace softbody
