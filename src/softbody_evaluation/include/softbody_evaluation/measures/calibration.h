#pragma once

#include <optional>
#include <vector>

#include "softbody_evaluation/measures/vertex_error.h"

namespace softbody::evaluation {

/// The bound that 90 % of the distances do not exceed, over their predicted RMS. It assumes that the three
/// components of an error are independent and normal, with equal variances: sqrt(chi2inv(0.9, 3) / 3).
constexpr double kBound90 = 1.44354;

/// Vertices with nearly the same prediction. The limits of the bins are powers of the square root of 2.
struct CalibrationBin {
  std::size_t count = 0;
  double predicted_rms = 0.0, error_rms = 0.0;  ///< [m]
};

/// The predicted standard deviations compared with the distances from the truth, over all frames.
struct CalibrationReport {
  double within_visible = kNothing, within_hidden = kNothing;  ///< share of vertices within the bound, 0..1
  double median_ratio = kNothing;                              ///< of bound to distance
  std::vector<CalibrationBin> bins;                            ///< without empty bins, in increasing order
};

/// Empty if no state has standard deviations.
std::optional<CalibrationReport> calibration(const std::vector<FrameVertexError>& frames);

}  // namespace softbody::evaluation
