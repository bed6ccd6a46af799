#include "outline/contour_posterior.h"

#include <algorithm>
#include <cmath>

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

}  // namespace

ContourPosterior contourPosterior(const std::vector<LinePixel>& line) {
  thread_local std::vector<LinePixel> ends;  // the log odds integrated up to each distance
  ends.assign(1, {line.front().distance, 0.0});
  double largest = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const double length = line[i].distance - line[i - 1].distance;
    const double from = line[i - 1].log_odds, slope = line[i].log_odds - from;
    const double start = ends.back().log_odds;
    for (int k = 1; k <= kPerPixel; ++k) {
      const double t = static_cast<double>(k) / kPerPixel;
      const double integral = start + kIndependentShare * length * t * (from + 0.5 * t * slope);
      ends.push_back({line[i - 1].distance + t * length, integral});
      largest = std::max(largest, integral);
    }
  }
  double sum = 0.0, first = 0.0, second = 0.0;
  for (const LinePixel& end : ends) {
    const double probability = std::exp(end.log_odds - largest);
    sum += probability;
    first += probability * end.distance;
    second += probability * end.distance * end.distance;
  }
  const double at_border = std::exp(std::max(ends.front().log_odds, ends.back().log_odds) - largest);
  const double mean = first / sum, variance = second / sum - mean * mean;
  const double doubt = std::sqrt(2.0 * std::max(0.0, largest - logLikelihoodAtOutline(ends)));
  return {mean, variance + kSmallestVariance, doubt, at_border > kLargestAtBorder};
}

}  // namespace softbody
