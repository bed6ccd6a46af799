#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "softbody_evaluation/models/model_distance.h"

namespace softbody::evaluation {

/// The report as a table.
std::string toText(const ModelReport& report);

/// The report as JSON: lengths in millimetres, volumes in millilitres, shares from 0 to 1.
nlohmann::json toJson(const ModelReport& report);

}  // namespace softbody::evaluation
