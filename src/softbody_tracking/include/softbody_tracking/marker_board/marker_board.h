#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "softbody_tracking/tool/tool_description.h"

namespace softbody {

/// A sheet of markers to print: in rows around its middle, x right, y up; poses are in the frame of the
/// sheet.
struct MarkerBoard {
  ToolDescription tool;
  double paper_width_m = 0.210, paper_height_m = 0.297;
};

/// Names that boardPaper knows.
std::vector<std::string> paperNames();

/// An empty sheet. @throw std::invalid_argument with the known names.
MarkerBoard boardPaper(const std::string& paper);

/// @param ids one marker each, at least one, all different. @param size_m side of the black square.
/// @throw std::invalid_argument if an id is not in the dictionary, or if they do not fit on the paper.
MarkerBoard layOutBoard(const std::string& dictionary, const std::vector<int>& ids, double size_m,
                        const std::string& paper);

/// To scale, with a ruler line to check the print by. @throw std::runtime_error if it cannot be written.
void writeBoardPdf(const MarkerBoard& board, const std::filesystem::path& path);
void writeBoardSvg(const MarkerBoard& board, const std::filesystem::path& path);
cv::Mat1b boardImage(const MarkerBoard& board, double dots_per_inch);

/// The tool YAML of the board, without a blade.
std::string boardYaml(const MarkerBoard& board);

}  // namespace softbody
