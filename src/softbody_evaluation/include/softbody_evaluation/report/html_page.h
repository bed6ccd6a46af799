#pragma once

#include <string>
#include <vector>

#include "softbody_evaluation/report/figures.h"
#include "softbody_evaluation/report/pictures.h"

namespace softbody::evaluation {

/// A self-contained HTML page with a table, a text and the pictures.
std::string htmlPage(const std::string& title, const std::vector<ComparedFigure>& rows,
                     const std::string& text, const Pictures& pictures);

}  // namespace softbody::evaluation
