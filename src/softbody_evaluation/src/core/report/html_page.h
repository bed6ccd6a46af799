#pragma once

#include <string>
#include <vector>

#include "report/film.h"
#include "report/metrics.h"
#include "report/pictures.h"
#include "report/verdict.h"

namespace softbody::evaluation {

/// What the page says of one result.
struct JudgedResult {
  std::string name;
  Verdict verdict;
  Film film;  ///< empty without a recording
};

/// A page of HTML that needs no other file and no network: for each result a verdict and a film, then a
/// table of the metrics with their meaning, the pictures and the text.
std::string htmlPage(const std::vector<JudgedResult>& results, const std::vector<ComparedMetric>& rows,
                     const std::string& text, const Pictures& pictures);

}  // namespace softbody::evaluation
