#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "softbody_evaluation/comparison/evaluator_options.h"
#include "softbody_evaluation/report/report.h"

namespace softbody::evaluation {

/// Compares the result with the truth (vertices by stamp) and with the recording's depth, if these are given.
/// A result in another frame is transformed into the frame of the truth or of the camera by the bags' /tf.
/// Writes report.json, report.html, plots and overlays into the report folder.
/// @throw std::invalid_argument, rosbag::BagException with bag and topic if something is missing or does not
/// fit.
Report evaluate(const EvaluatorOptions& options);

/// Two results of one recording.
struct Comparison {
  Report first, second;
};

/// Evaluates two results with the same truth and recording. One report folder shows both.
Comparison evaluateBoth(const EvaluatorOptions& options, const std::string& other_result);

/// Both reports, and their metrics side by side.
nlohmann::json toJson(const Comparison& comparison);

}  // namespace softbody::evaluation
