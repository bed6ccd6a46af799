#include "constraints/box_grid.h"

namespace softbody {

template <typename Visit>
void BoxGrid::visitCells(const Box& box, Visit visit) const {
  const Eigen::Array3i first = cellOf(box.min()), last = cellOf(box.max());
  for (int z = first.z(); z <= last.z(); ++z) {
    for (int y = first.y(); y <= last.y(); ++y) {
      for (int x = first.x(); x <= last.x(); ++x) visit(static_cast<std::size_t>(indexOf({x, y, z})));
    }
  }
}

Eigen::Array3i BoxGrid::cellOf(const Eigen::Vector3d& point) const {
  const Eigen::Array3d cell = (point - bounds_.min()).array() / cell_size_;
  return cell.max(0.0).min((counts_ - 1).cast<double>()).cast<int>();
}

void BoxGrid::reserve(std::size_t count) {
  constexpr std::size_t kCellsOfBox = 27;  // of a box that is not much larger than the mean
  boxes_.reserve(count);
  entries_.reserve(kCellsOfBox * count);
  begins_.reserve((kMaxCells + 1) * (kMaxCells + 1) * (kMaxCells + 1) + 1);
}

void BoxGrid::set(const std::vector<Box>& boxes) {
  boxes_ = boxes;
  bounds_.setEmpty();
  double sides = 0.0;
  for (const Box& box : boxes_) {
    bounds_.extend(box);
    sides += box.sizes().maxCoeff();
  }
  // Cells as large as the boxes: then each is in a few cells, and a cell holds a few boxes.
  cell_size_ = std::max(sides / static_cast<double>(boxes_.size()), bounds_.sizes().maxCoeff() / kMaxCells);
  counts_ = (bounds_.sizes().array() / cell_size_).floor().cast<int>() + 1;
  begins_.assign(static_cast<std::size_t>(counts_.prod()) + 1, 0);
  for (const Box& box : boxes_) visitCells(box, [this](std::size_t cell) { ++begins_[cell + 1]; });
  for (std::size_t cell = 1; cell < begins_.size(); ++cell) begins_[cell] += begins_[cell - 1];
  entries_.resize(static_cast<std::size_t>(begins_.back()));
  // Filling moves each begin to its end, which is the begin of the next cell.
  for (std::size_t k = 0; k < boxes_.size(); ++k)
    visitCells(boxes_[k], [&](std::size_t cell) { entries_[begins_[cell]++] = static_cast<int>(k); });
  for (std::size_t cell = begins_.size() - 1; cell > 0; --cell) begins_[cell] = begins_[cell - 1];
  begins_[0] = 0;
}

}  // namespace softbody
