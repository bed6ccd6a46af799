#pragma once

#include <nlohmann/json_fwd.hpp>

#include "softbody_evaluation/report/report.h"

namespace softbody::evaluation {

/// The report as JSON: lengths in millimetres, shares from 0 to 1. The names hold the units.
nlohmann::json toJson(const Report& report);

}  // namespace softbody::evaluation
