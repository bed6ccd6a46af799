#include "labels/depth_evidence.h"

#include <algorithm>
#include <cmath>

namespace softbody {
namespace {

// Standard deviation of depth around the prediction [m], at up to 1 m: error of the prediction, slope and
// noise.
constexpr double kDeviation = 0.012;
// Share of the surroundings that touch the body without a step, like the table below it, and how closely [m].
constexpr double kTouchingShare = 0.3, kTouchingDeviation = 0.03;
// Density of the depth of other surroundings [1/m]: anywhere within a metre.
constexpr double kAnywhere = 1.0;
// Share of pixels whose depth is wrong: filled holes, and edges.
constexpr double kWrongShare = 0.05;

double gauss(double x, double deviation) {
  const double ratio = x / deviation;
  return std::exp(-0.5 * ratio * ratio) / (deviation * std::sqrt(2.0 * M_PI));
}

/// @param elsewhere density of the surroundings that do not touch.
double logOddsOf(double difference, double scale, double elsewhere) {
  const double body = (1.0 - kWrongShare) * gauss(difference, scale * kDeviation) + kWrongShare * kAnywhere;
  const double other =
      kTouchingShare * gauss(difference, scale * kTouchingDeviation) + (1.0 - kTouchingShare) * elsewhere;
  return std::log(body / other);
}

}  // namespace

std::array<double, 2 * DepthEvidence::kHalf + 1> DepthEvidence::makeTable() {
  std::array<double, 2 * kHalf + 1> table{};
  for (int i = 0; i <= 2 * kHalf; ++i)
    table[static_cast<std::size_t>(i)] = logOddsOf((i - kHalf) * kCell, 1.0, kAnywhere);
  return table;
}

const std::array<double, 2 * DepthEvidence::kHalf + 1> DepthEvidence::kTable = makeTable();

double DepthEvidence::logOddsBefore(double behind, double measured, double predicted) {
  const double scale = std::max(1.0, predicted);
  return logOddsOf(measured - predicted, scale, gauss(measured - behind, scale * kDeviation));
}

/// An occluder lies anywhere before the body, and more often near to it.
double DepthEvidence::logOddsBeforeBody(double difference, double deviation) {
  const double body = (1.0 - kWrongShare) * gauss(difference, deviation) + kWrongShare * kAnywhere;
  const double is_before = 0.5 * std::erfc(difference / (deviation * std::sqrt(2.0)));
  const double occluder =
      is_before * std::exp(std::min(0.0, difference) / kTouchingDeviation) / kTouchingDeviation;
  return std::log(body / (occluder + kWrongShare * kWrongShare * kAnywhere));
}

}  // namespace softbody
