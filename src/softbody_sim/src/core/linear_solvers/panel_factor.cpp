#include "linear_solvers/panel_factor.h"

#include <Eigen/Dense>
#include <algorithm>

namespace softbody {
namespace {

/// Columns of a panel at most: an inverse triangle costs the square of them for each.
constexpr int kMaxWidth = 64;

/// A matrix in memory that only grows.
template <typename T>
Eigen::Map<Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>> inMemory(std::vector<T>* memory, int rows,
                                                                      int columns) {
  const auto size = static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns);
  if (memory->size() < size) memory->resize(size);
  return {memory->data(), rows, columns};
}

}  // namespace

template <typename T>
void PanelFactor<T>::set(const PositiveDefiniteSolver& solver, const Numbers& scale, bool halves) {
  panels_.clear();
  rows_.clear();
  values_.clear();
  halves_.clear();
  largest_ = 0;
  for (int index = 0; index < solver.supernodeCount(); ++index) {
    const Supernode node = solver.supernode(index);
    for (int first = 0; first < node.width(); first += kMaxWidth)
      append(node, first, std::min(kMaxWidth, node.width() - first), scale, halves);
  }
}

template <typename T>
void PanelFactor<T>::append(const Supernode& node, int first, int width, const Numbers& scale, bool halves) {
  const int end = first + width, height = node.width() + node.below(), count = height - end;
  panels_.push_back({node.first + first, width, static_cast<int>(rows_.size()), count, 0, 0});
  rows_.insert(rows_.end(), node.rows + end, node.rows + height);
  const auto begin = [&] { return static_cast<std::size_t>(kUnit) * (values_.size() + halves_.size()); };
  const auto own_scale = scale.segment(node.first + first, width);
  Block triangle = inMemory(&triangle_, width, width), inverse = inMemory(&inverse_, width, width),
        below = inMemory(&below_, count, width);
  triangle = own_scale.asDiagonal() * node.values.block(first, first, width, width).template cast<T>();
  inverse.setIdentity();
  triangle.template triangularView<Eigen::Lower>().solveInPlace(inverse);
  panels_.back().triangle_begin = begin();
  appendBlock(inverse, true, halves);
  for (int c = 0; c < width; ++c) {
    for (int k = 0; k < count; ++k)
      below(k, c) = scale[node.rows[end + k]] * static_cast<T>(node.values(end + k, first + c));
  }
  panels_.back().below_begin = begin();
  appendBlock(below, false, halves);
  const int padded = (std::max(width, count) + kStrip * kUnit - 1) / (kStrip * kUnit) * kStrip * kUnit;
  largest_ = std::max(largest_, padded);
}

template <typename T>
void PanelFactor<T>::appendBlock(const Block& block, bool is_triangle, bool halves) {
  const int rows = static_cast<int>(block.rows()), units = (rows + kUnit - 1) / kUnit;
  for (int unit = 0, count = 0; unit < units; unit += count) {
    count = std::min(kStrip, units - unit);
    const int begin = unit * kUnit, end = begin + count * kUnit;
    const int columns = is_triangle ? std::min(end, rows) : static_cast<int>(block.cols());
    for (int c = 0; c < columns; ++c) {
      for (int row = begin; row < end; row += kUnit) {
        Eigen::Matrix<T, kUnit, 1> column = Eigen::Matrix<T, kUnit, 1>::Zero();
        const int filled = std::min(kUnit, rows - row);
        if (filled > 0) column.head(filled) = block.col(c).segment(row, filled);
        if (!halves) {
          std::copy_n(column.data(), kUnit, values_.emplace_back().lane);
          continue;
        }
        Unit<std::uint16_t>& unit_of_halves = halves_.emplace_back();
        for (int k = 0; k < kUnit; ++k)
          unit_of_halves.lane[k] = static_cast<Eigen::half>(static_cast<float>(column[k])).x;
      }
    }
  }
}

template class PanelFactor<float>;
template class PanelFactor<double>;

}  // namespace softbody
