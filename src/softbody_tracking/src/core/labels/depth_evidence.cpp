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

// Pixels of the surroundings that say as much as what is known without any; many of them show one surface.
constexpr double kFewestAround = 1000.0;

double gauss(double x, double deviation) {
  const double ratio = x / deviation;
  return std::exp(-0.5 * ratio * ratio) / (deviation * std::sqrt(2.0 * M_PI));
}

double densityOfBody(double difference, double scale) {
  return (1.0 - kWrongShare) * gauss(difference, scale * kDeviation) + kWrongShare * kAnywhere;
}

/// Before anything was seen. @param elsewhere density of the surroundings that do not touch.
double densityAround(double difference, double scale, double elsewhere) {
  return kTouchingShare * gauss(difference, scale * kTouchingDeviation) + (1.0 - kTouchingShare) * elsewhere;
}

}  // namespace

void DepthCounts::add(double scaled, float weight) {
  const auto bin = static_cast<int>(std::floor(scaled / kWidth)) + kBins / 2;
  all += weight;
  if (bin >= 0 && bin < kBins) pixels[static_cast<std::size_t>(bin)] += weight;
}

void DepthCounts::blend(const DepthCounts& newest, float share) {
  for (std::size_t bin = 0; bin < pixels.size(); ++bin)
    pixels[bin] += share * (newest.pixels[bin] - pixels[bin]);
  all += share * (newest.all - all);
}

DepthEvidence::Table DepthEvidence::tableOf(double (*density)(double difference)) {
  Table table{};
  for (int i = 0; i <= 2 * kHalf; ++i) table[static_cast<std::size_t>(i)] = density((i - kHalf) / kPerMetre);
  return table;
}

void DepthEvidence::compare(const DepthCounts& around) {
  static const Table kBody = tableOf([](double difference) { return densityOfBody(difference, 1.0); });
  static const Table kUnknown =
      tableOf([](double difference) { return densityAround(difference, 1.0, kAnywhere); });
  const auto count = [&](int bin) {
    return around.pixels[static_cast<std::size_t>(std::clamp(bin, 0, DepthCounts::kBins - 1))];
  };
  for (std::size_t i = 0; i < table_.size(); ++i) {
    // Between the middles of two bins the density is linear.
    const double place =
        (static_cast<int>(i) - kHalf) / (kPerMetre * DepthCounts::kWidth) + 0.5 * DepthCounts::kBins - 0.5;
    const int bin = static_cast<int>(std::floor(place));
    const double seen = (count(bin) + (place - bin) * (count(bin + 1) - count(bin))) / DepthCounts::kWidth;
    table_[i] = static_cast<float>(
        std::log(kBody[i] * (around.all + kFewestAround) / (seen + kFewestAround * kUnknown[i])));
  }
}

double DepthEvidence::logOddsBefore(double behind, double measured, double predicted) {
  const double scale = std::max(1.0, predicted);
  const double difference = measured - predicted;
  return std::log(densityOfBody(difference, scale) /
                  densityAround(difference, scale, gauss(measured - behind, scale * kDeviation)));
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
