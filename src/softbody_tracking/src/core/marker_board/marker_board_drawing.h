#pragma once

#include <filesystem>
#include <opencv2/core.hpp>

#include "marker_board/marker_board.h"

namespace softbody {

/// Draws the sheet to scale, with a ruler to check the print. @throw std::runtime_error if the file cannot be
/// written.
void writeBoardPdf(const MarkerBoard& board, const std::filesystem::path& path);
void writeBoardSvg(const MarkerBoard& board, const std::filesystem::path& path);

/// The same sheet as a grey image.
cv::Mat1b boardImage(const MarkerBoard& board, double dots_per_inch);

}  // namespace softbody
