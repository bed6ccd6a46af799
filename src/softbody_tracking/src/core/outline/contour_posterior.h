#pragma once

#include <vector>

namespace softbody {

/// A pixel on a line across the predicted outline.
struct LinePixel {
  double distance = 0.0;  ///< of its centre from the predicted outline, along the line [px]; positive outside
  double log_odds = 0.0;  ///< of the body against everything else; 0: the pixel says nothing
};

/// A normal distribution of a distance.
struct ContourEnd {
  double mean = 0.0;      ///< distance from the predicted outline [px], positive outside
  double variance = 0.0;  ///< [px^2]; infinite: nothing is known
};

/// Where the body ends on a line across its outline.
struct ContourPosterior {
  ContourEnd end;  ///< by the line alone
  /// What the line adds to the prediction: the normal distribution whose product with that of the prediction
  /// has the mean and the variance of line and prediction together (expectation propagation: Minka 2001). So
  /// a line that says nothing adds nothing, and of two ends that fit the line, the one near the prediction
  /// counts.
  ContourEnd added;
  double together = 0.0;  ///< mean of line and prediction [px]
  /// How much the line contradicts an end at the predicted outline [standard deviations]: the square root of
  /// twice the logarithm of the likelihood ratio between the best end and that one (Wilks 1938).
  double doubt = 0.0;
  bool beyond = false;  ///< the end may well lie beyond the line; `end` is then useless
};

/// Variance of the predicted outline [px^2]. @param error_px usual error of the prediction; a sudden motion
/// is several times as large. 0: it is not known yet, so the prediction says nothing.
double predictionVariance(double error_px);

/// If the body ends at the distance d, the pixels before d show the body, and those behind show something
/// else. So the logarithm of the probability of d is, up to a constant, the integral of the log odds up to d
/// (region-based tracking along lines: Stoiber et al. 2022, SRT3D, with independent pixels).
/// @param line at least two pixels with increasing distances, the body first.
/// @param prediction_variance of the predicted outline, which is at 0 [px^2].
ContourPosterior contourPosterior(const std::vector<LinePixel>& line, double prediction_variance);

}  // namespace softbody
