#pragma once

#include <string>

#include "softbody_evaluation/report/report.h"

namespace softbody::evaluation {

/// The report as tables and sentences.
std::string toText(const Report& report);
/// The table of depth residuals, a row for each window of frames; empty without depth.
std::string residualTable(const Report& report);

}  // namespace softbody::evaluation
