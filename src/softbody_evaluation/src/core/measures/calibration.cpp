#include "softbody_evaluation/measures/calibration.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace softbody::evaluation {
namespace {

constexpr double kSmallest = 1e-6;  // smaller predictions are in the first bin [m]

/// Sums over pairs of a prediction and a distance.
class CalibrationSums {
 public:
  /// @return the share within the bound.
  double add(const std::vector<FrameVertexError>& frames, std::vector<float> FrameVertexError::*distances,
             std::vector<float> FrameVertexError::*deviations) {
    std::size_t count = 0, within = 0;
    for (const FrameVertexError& frame : frames) {
      for (std::size_t i = 0; i < (frame.*deviations).size(); ++i) {
        within += addPair((frame.*deviations)[i], (frame.*distances)[i]);
        ++count;
      }
    }
    return count > 0 ? static_cast<double>(within) / static_cast<double>(count) : kNothing;
  }

  CalibrationReport report() {
    CalibrationReport report;
    report.median_ratio = summarize(std::move(ratios_)).median;
    for (const auto& [number, bin] : bins_) {
      const double count = static_cast<double>(bin.count);
      report.bins.push_back(
          {bin.count, std::sqrt(bin.predicted_rms / count), std::sqrt(bin.error_rms / count)});
    }
    return report;
  }

 private:
  bool addPair(double deviation, double distance) {
    CalibrationBin& bin =
        bins_[static_cast<int>(std::floor(2.0 * std::log2(std::max(deviation, kSmallest))))];
    ++bin.count;
    bin.predicted_rms += deviation * deviation;
    bin.error_rms += distance * distance;
    if (distance > 0.0) ratios_.push_back(static_cast<float>(kBound90 * deviation / distance));
    return distance <= kBound90 * deviation;
  }

  std::map<int, CalibrationBin> bins_;  ///< with sums of squares
  std::vector<float> ratios_;
};

}  // namespace

std::optional<CalibrationReport> calibration(const std::vector<FrameVertexError>& frames) {
  CalibrationSums sums;
  const double visible = sums.add(frames, &FrameVertexError::visible, &FrameVertexError::visible_deviations),
               hidden = sums.add(frames, &FrameVertexError::hidden, &FrameVertexError::hidden_deviations);
  CalibrationReport report = sums.report();
  if (report.bins.empty()) return std::nullopt;
  report.within_visible = visible;
  report.within_hidden = hidden;
  return report;
}

}  // namespace softbody::evaluation
