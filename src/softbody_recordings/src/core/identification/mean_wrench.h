#pragma once

#include <optional>
#include <string>

#include "identification/seen_frame.h"
#include "softbody_sim/identification/material_problem.h"

namespace softbody {

/// The mean of a sensor's samples from `begin` to `end`, at the pin or obstacle of its name. Empty if there
/// is no sample, or if no such pin or obstacle acts. The samples' errors are taken to be independent; the
/// deviation of the mean is at least the record's.
std::optional<MeasuredWrench> meanWrench(const WrenchRecord& record, const NamedSurroundings& around,
                                         Nanoseconds begin, Nanoseconds end);

/// Standard deviation of one component of a single sample, from second differences, which a slow change does
/// not reach; 0 with fewer than 3 samples.
double noiseOf(const std::vector<WrenchSample>& samples);

}  // namespace softbody
