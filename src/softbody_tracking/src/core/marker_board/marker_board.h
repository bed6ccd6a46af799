#pragma once

#include <string>
#include <vector>

#include "softbody_tracking/tool/tool_description.h"

namespace softbody {

/// Paper with markers to print. Poses are in the paper's frame: origin at the centre, x right, y up, z out
/// of the print.
struct MarkerBoard {
  ToolDescription tool;
  double paper_width_m = 0.210, paper_height_m = 0.297;
  double free_width_m = 0.0, free_height_m = 0.0;  ///< middle without markers; 0: none
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

/// Paper with a ring of markers along its edges. An object lies in the free middle, and the markers say where
/// the camera is.
/// @param ids one for each place of the ring, clockwise from the top left; empty: as many as there are
/// places, from 50 on, so that none is taken for a tool's marker of DICT_4X4_50. @param size_m side of the
/// black square; 0: 2/15 of the paper's width, in whole millimetres. @throw std::invalid_argument as
/// layOutBoard, and if the number of ids is wrong.
MarkerBoard layOutSheet(const std::string& dictionary, std::vector<int> ids, double size_m,
                        const std::string& paper);

/// A tool YAML with the board's markers and without a blade.
std::string boardYaml(const MarkerBoard& board);

}  // namespace softbody
