#pragma once

#include <array>
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
};

/// What the cells of the last frame say about those of this one.
class LabelRecall {
 public:
  /// @param last must outlive it. @param reach_px the farthest that anything moves in a frame.
  LabelRecall(const LabelMemory& last, int reach_px);

  /// Log odds that a cell shows the body, by the cells of the last frame that are near in space.
  /// @param center of the cell [px]. @return 0 if no cell is near.
  double logOdds(const cv::Point& center, float depth_m) const;

 private:
  static constexpr int kLooks = 3;  ///< cells that are looked at, each way
  static constexpr int kSide = 2 * kLooks + 1;

  const LabelMemory& last_;
  int step_;                                  ///< from one of them to the next [cells]
  std::array<float, kSide * kSide> weights_;  ///< of them by their distance, row by row
};

LabelMemory memoryOf(const LabelCells& cells);

}  // namespace softbody
