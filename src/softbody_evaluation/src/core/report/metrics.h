#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "softbody_evaluation/report/report.h"

namespace softbody::evaluation {

/// One number of a report.
struct Metric {
  std::string name, unit;
  double value = 0.0;
};

/// The numbers by which results are compared, in the order of the report.
std::vector<Metric> metrics(const Report& report);

/// One metric of two results. A result without the metric leaves its value empty.
struct ComparedMetric {
  std::string name, unit;
  std::optional<double> first, second;
};

/// The metrics of one report as rows without a second value.
std::vector<ComparedMetric> tableRows(const Report& report);
/// The metrics of two reports, row by row.
std::vector<ComparedMetric> compare(const Report& first, const Report& second);

nlohmann::json toJson(const std::vector<ComparedMetric>& comparison);
std::string toText(const std::vector<ComparedMetric>& comparison);

}  // namespace softbody::evaluation
