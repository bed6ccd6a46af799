#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "report/pictures.h"

namespace softbody::evaluation {

/// Writes report.json, report.html and the pictures. They replace an earlier report completely; if writing
/// fails, the earlier report stays. report.json lists all files under "files".
/// @throw std::invalid_argument if the folder holds files that are not part of a report; std::runtime_error
/// if it cannot be written.
void writeReportFolder(const std::string& folder, const nlohmann::json& document, const std::string& page,
                       const Pictures& pictures);

}  // namespace softbody::evaluation
