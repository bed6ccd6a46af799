#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "softbody_evaluation/report/report.h"

namespace softbody::evaluation {

/// One number of a report.
struct Figure {
  std::string name, unit;
  double value = 0.0;
};

/// The numbers by which results are compared, in the order of the report.
std::vector<Figure> figures(const Report& report);

/// One figure of two results. A result without the figure leaves its value empty.
struct ComparedFigure {
  std::string name, unit;
  std::optional<double> first, second;
};

/// The figures of one report as rows without a second value.
std::vector<ComparedFigure> tableRows(const Report& report);
/// The figures of two reports, row by row.
std::vector<ComparedFigure> compare(const Report& first, const Report& second);

nlohmann::json toJson(const std::vector<ComparedFigure>& comparison);
std::string toText(const std::vector<ComparedFigure>& comparison);

}  // namespace softbody::evaluation
