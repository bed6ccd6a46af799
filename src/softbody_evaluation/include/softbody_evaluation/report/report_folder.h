#pragma once

#include <map>
#include <opencv2/core.hpp>
#include <string>

#include "softbody_evaluation/report/report.h"

namespace softbody::evaluation {

/// Pictures for the report, by file name.
using Pictures = std::map<std::string, cv::Mat3b>;

/// One self-contained page: a table, the words and the pictures. @param rows of compare, or one report's
/// figures as `first` alone.
std::string htmlPage(const std::string& title, const std::vector<ComparedFigure>& rows,
                     const std::string& words, const Pictures& pictures);

/// Writes report.json, report.html and the pictures as a whole: all of it replaces an earlier report, or
/// nothing changes. @throw std::invalid_argument if the folder holds anything but a report, or cannot be
/// written.
void writeReportFolder(const std::string& folder, const nlohmann::json& document, const std::string& page,
                       const Pictures& pictures);

}  // namespace softbody::evaluation
