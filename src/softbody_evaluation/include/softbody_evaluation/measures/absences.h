#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "softbody_evaluation/measures/statistics.h"

namespace softbody::evaluation {

/// What a frame of the truth shows of the body, and how well it was followed.
struct FrameSight {
  double time_s = 0.0;
  double covered_share = 0.0;  ///< of the vertices seen at first, how many are hidden now, 0..1
  double mean_error = std::numeric_limits<double>::infinity();  ///< [m]; infinite: no answer
  std::optional<double> unhidden_error;  ///< the same if nothing had ever hidden the body, where known [m]
  std::vector<float> covered_errors;     ///< of the vertices that are hidden now [m]
};

/// A time in which more than a quarter of what was seen at first is hidden: an occluder, or out of view.
struct Absence {
  double begin_s = 0.0, end_s = 0.0;
  double covered_share = 0.0;        ///< at most
  double normal = kNothing;          ///< error at its end if nothing had hidden the body, where known;
                                     ///< otherwise p95 of the frames' mean errors before any absence [m]
  Summary covered;                   ///< errors of the hidden part meanwhile [m]
  std::optional<double> recovery_s;  ///< from the end until the mean error is back; nothing: never
  std::optional<double> recovery_to_before_s;  ///< the same, whatever is known of the body unhidden
};

/// Absences of at least 0.2 s. The error is back to normal when it is at most 1.2 times the normal one for
/// 0.2 s on end: the same frame's if nothing had hidden the body, where that is known.
/// @param frames in time order; the first is the reference.
std::vector<Absence> absences(const std::vector<FrameSight>& frames);

}  // namespace softbody::evaluation
