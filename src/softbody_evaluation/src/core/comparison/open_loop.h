#pragma once

#include <string>

#include "softbody_evaluation/records/surface_record.h"

namespace softbody::evaluation {

/// The stamp of the first state at the end of a result that was predicted without an image.
/// @param share of the truth's time that must be predicted. @param name of the result, for errors.
/// @throw std::invalid_argument if fewer are.
Nanoseconds beginOfOpenLoop(const SurfaceRecord& result, const SurfaceRecord& truth, double share,
                            const std::string& name);

/// Takes a record's states from a stamp on.
SurfaceRecord takeFrom(Nanoseconds stamp, SurfaceRecord* record);

}  // namespace softbody::evaluation
