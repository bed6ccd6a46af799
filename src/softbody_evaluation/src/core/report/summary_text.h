#pragma once

#include <string>

#include "softbody_evaluation/report/report.h"

namespace softbody::evaluation {

/// The verdict with its reasons, line by line.
std::string verdictText(const Report& report);

/// A table of the metrics that decide the verdict, with their limits.
std::string summaryTable(const Report& report);

/// The table of depth residuals, a row for each window of frames; empty without depth.
std::string residualTable(const Report& report);

/// What the page shows below its pictures: the residuals and the notes.
std::string detailsText(const Report& report);

}  // namespace softbody::evaluation
