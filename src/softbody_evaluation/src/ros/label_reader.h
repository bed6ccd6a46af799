#pragma once

#include <optional>
#include <string>

#include "softbody_evaluation/measures/label_agreement.h"

namespace softbody::evaluation {

/// Compares the label images (mono8, as in pixel_labels.h) of a result with those of the truth, by stamp.
/// Nothing if one of the bags has none.
/// @throw std::invalid_argument with the bag and the topic if an image has another encoding or size.
std::optional<LabelReport> compareLabels(const std::string& result, const std::string& result_topic,
                                         const std::string& truth, const std::string& truth_topic);

}  // namespace softbody::evaluation
