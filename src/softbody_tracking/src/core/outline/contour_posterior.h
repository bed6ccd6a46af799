#pragma once

#include <vector>

namespace softbody {

/// A pixel on a line across the predicted outline.
struct LinePixel {
  double distance = 0.0;  ///< of its centre from the predicted outline, along the line [px]; positive outside
  double log_odds = 0.0;  ///< of the body against everything else; 0: the pixel says nothing
};

/// Where the body ends on a line across its outline.
struct ContourPosterior {
  double mean = 0.0;      ///< distance from the predicted outline [px], positive outside
  double variance = 0.0;  ///< [px^2]
  /// How much the line contradicts an end at the predicted outline [standard deviations]: the square root of
  /// twice the logarithm of the likelihood ratio between the best end and that one (Wilks 1938).
  double doubt = 0.0;
  bool beyond = false;  ///< the end may well lie beyond the line; mean and variance are then useless
};

/// If the body ends at the distance d, the pixels before d show the body, and those behind show something
/// else. So the logarithm of the probability of d is, up to a constant, the integral of the log odds up to d
/// (region-based tracking along lines: Stoiber et al. 2022, SRT3D, with independent pixels).
/// @param line at least two pixels with increasing distances, the body first.
ContourPosterior contourPosterior(const std::vector<LinePixel>& line);

}  // namespace softbody
