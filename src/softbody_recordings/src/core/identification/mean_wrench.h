#pragma once

#include <optional>
#include <string>

#include "identification/seen_frame.h"
#include "softbody_sim/identification/material_problem.h"

namespace softbody {

/// The mean of a sensor's samples in a time, at what has its name; empty if there is none, or nothing of the
/// name acts. Its deviation is that of the mean of independent samples, but at least the record's.
std::optional<MeasuredWrench> meanWrench(const WrenchRecord& record, const NamedSurroundings& around,
                                         Nanoseconds begin, Nanoseconds end);

/// Standard deviation of one component of a single sample, from second differences, which a slow change does
/// not reach; 0 with fewer than 3 samples.
double noiseOf(const std::vector<WrenchSample>& samples);

}  // namespace softbody
