#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "softbody_evaluation/measures/statistics.h"

namespace softbody::evaluation {

/// One frame of the truth: how much of the body is hidden, and the error of the result.
struct FrameOcclusion {
  double time_s = 0.0;
  double covered_share = 0.0;  ///< hidden share of the vertices that were visible at first, 0..1
  double mean_error = std::numeric_limits<double>::infinity();  ///< [m]; infinite without an answer
  std::optional<double> unhidden_error;  ///< mean error for the same motion without occluders, if known [m]
  std::vector<float> covered_errors;     ///< of the hidden vertices [m]
};

/// An interval in which more than a quarter of the vertices visible at first are hidden or out of view.
struct Absence {
  double begin_s = 0.0, end_s = 0.0;
  double covered_share = 0.0;        ///< largest share
  double normal = kNothing;          ///< error at its end for the same motion without occluders, if known;
                                     ///< otherwise p95 of the mean errors before the first absence [m]
  Summary covered;                   ///< errors of the hidden vertices [m]
  std::optional<double> recovery_s;  ///< from the interval's end until the error is normal; empty: never
  std::optional<double> recovery_to_before_s;  ///< the same, always compared with the error before
};

/// The absences of at least 0.2 s. The error is normal again when it is at most 1.2 times the normal error
/// for 0.2 s. The normal error is that of the same frame without occluders, if known.
/// @param frames in the order of time; the first frame is the reference.
std::vector<Absence> absences(const std::vector<FrameOcclusion>& frames);

}  // namespace softbody::evaluation
