#pragma once

#include <Eigen/Geometry>
#include <vector>

namespace softbody {

/// Boxes in the cells of a uniform grid, to find those near a place. Keeps its memory.
class BoxGrid {
 public:
  using Box = Eigen::AlignedBox3d;

  /// Takes the memory for as many boxes of ordinary shape, so that set() allocates nothing.
  void reserve(std::size_t count);

  /// @param boxes not empty.
  void set(const std::vector<Box>& boxes);

  /// Calls visit(k) once for each box k that the given one intersects.
  template <typename Visit>
  void visit(const Box& box, Visit visit) const {
    const Box inside = box.intersection(bounds_);
    if (inside.isEmpty()) return;
    const Eigen::Array3i first = cellOf(inside.min()), last = cellOf(inside.max());
    for (int z = first.z(); z <= last.z(); ++z) {
      for (int y = first.y(); y <= last.y(); ++y) {
        for (int x = first.x(); x <= last.x(); ++x) {
          const auto cell = static_cast<std::size_t>(indexOf({x, y, z}));
          for (int k = begins_[cell]; k < begins_[cell + 1]; ++k) {
            const Box both = inside.intersection(boxes_[static_cast<std::size_t>(entries_[k])]);
            // Several cells hold the same boxes; the cell of the lowest common corner counts.
            if (!both.isEmpty() && indexOf(cellOf(both.min())) == static_cast<int>(cell)) visit(entries_[k]);
          }
        }
      }
    }
  }

 private:
  Eigen::Array3i cellOf(const Eigen::Vector3d& point) const;
  int indexOf(const Eigen::Array3i& cell) const {
    return cell.x() + counts_.x() * (cell.y() + counts_.y() * cell.z());
  }
  static constexpr int kMaxCells = 32;  ///< along an axis

  template <typename Visit>
  void visitCells(const Box& box, Visit visit) const;

  std::vector<Box> boxes_;
  Box bounds_;
  Eigen::Array3i counts_ = Eigen::Array3i::Ones();
  double cell_size_ = 1.0;
  std::vector<int> begins_, entries_;  ///< per cell: where its boxes begin in the entries
};

}  // namespace softbody
