#pragma once

#include <optional>
#include <string>

#include "softbody_evaluation/measures/force_agreement.h"

namespace softbody::evaluation {

/// Compares the external forces (softbody_msgs/Forces) of a result with those of the truth, by stamp. Nothing
/// if one of the bags has none, or the result does not know them in newtons.
/// @throw std::invalid_argument with the bag and the topic if a message has another type, or forces and truth
/// are in different frames.
std::optional<ForceReport> compareForces(const std::string& result, const std::string& result_topic,
                                         const std::string& truth, const std::string& truth_topic);

}  // namespace softbody::evaluation
