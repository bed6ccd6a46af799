#include "labels/label_cells.h"

namespace softbody {

LabelCells makeCells(const cv::Rect& region, const SurfaceSamples& samples, int margin_px) {
  LabelCells cells;
  cells.size_px = samples.block_px;
  const int margin = (margin_px + samples.block_px - 1) / samples.block_px;
  cells.origin = region.tl() - cv::Point(margin, margin) * samples.block_px;
  cells.grid = samples.grid.size() + cv::Size(2 * margin, 2 * margin);
  cells.cells.resize(static_cast<std::size_t>(cells.grid.area()));
  std::vector<cv::Point> reached;
  for (int row = 0; row < samples.grid.rows; ++row) {
    for (int column = 0; column < samples.grid.cols; ++column) {
      if (samples.grid(row, column) < 0) continue;
      reached.emplace_back(column + margin, row + margin);
      cells.at(reached.back()).sample = samples.grid(row, column);
    }
  }
  // The other cells take the nearest sample, in steps of cells.
  for (std::size_t i = 0; i < reached.size(); ++i) {
    const LabelCell from = cells.at(reached[i]);
    for (const cv::Point& step : {cv::Point(1, 0), cv::Point(-1, 0), cv::Point(0, 1), cv::Point(0, -1)}) {
      const cv::Point next = reached[i] + step;
      if (!cells.contains(next) || cells.at(next).sample >= 0) continue;
      cells.at(next).sample = from.sample;
      cells.at(next).distance = from.distance + 1;
      reached.push_back(next);
    }
  }
  for (LabelCell& cell : cells.cells)
    if (cell.sample >= 0)
      cell.predicted =
          static_cast<float>(samples.samples[static_cast<std::size_t>(cell.sample)].position.z());
  return cells;
}

}  // namespace softbody
