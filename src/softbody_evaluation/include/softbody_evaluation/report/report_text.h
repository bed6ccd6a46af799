#pragma once

#include <string>

#include "softbody_evaluation/report/report.h"

namespace softbody::evaluation {

/// The report as tables and sentences.
std::string toText(const Report& report);

}  // namespace softbody::evaluation
