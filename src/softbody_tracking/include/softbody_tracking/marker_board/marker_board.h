#pragma once

#include <string>
#include <vector>

#include "softbody_tracking/tool/tool_description.h"

namespace softbody {

/// A sheet of markers to print, in rows around its centre. Poses are in the sheet's frame: origin at the
/// centre, x right, y up.
struct MarkerBoard {
  ToolDescription tool;
  double paper_width_m = 0.210, paper_height_m = 0.297;
};

/// Names that boardPaper accepts.
std::vector<std::string> paperNames();

/// An empty sheet. @throw std::invalid_argument for an unknown name, with the known names.
MarkerBoard boardPaper(const std::string& paper);

/// A sheet with one marker for each id. @param ids at least one, all different. @param size_m side of the
/// black square. @throw std::invalid_argument if an id is not in the dictionary or the markers do not fit on
/// the paper.
MarkerBoard layOutBoard(const std::string& dictionary, const std::vector<int>& ids, double size_m,
                        const std::string& paper);

/// A tool YAML with the board's markers and without a blade.
std::string boardYaml(const MarkerBoard& board);

}  // namespace softbody
