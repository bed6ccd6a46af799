#pragma once

#include <opencv2/core.hpp>

namespace softbody {

struct LabelCells;

/// The cells of a labelled frame, for the next one: what appeared before the body a moment ago does not
/// become the body by standing close to it.
struct LabelMemory {
  int size_px = 1;   ///< side of a cell
  cv::Point origin;  ///< first pixel of the first cell [px]
  /// Mean measured depth of each cell [m]; 0: background, or nothing measured. May be empty.
  cv::Mat1f depth;
  cv::Mat1f body;  ///< probability of each cell that it shows the body

  /// Log odds that a cell shows the body, by the cells of the last frame that are near in space. 0 if there
  /// are none. @param center of the cell [px]. @param reach_px the farthest that anything moves in a frame.
  double logOdds(const cv::Point& center, float depth_m, int reach_px) const;
};

LabelMemory memoryOf(const LabelCells& cells);

}  // namespace softbody
