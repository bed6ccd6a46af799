#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "linear_solvers/positive_definite_solver.h"

namespace softbody {

/// A Cholesky factor L of a matrix for the vector kernels, in panels of adjacent columns that share their
/// rows: for each the inverse of its triangle and the block below it. Blocks are stored in strips of up to
/// kStrip units of rows; a strip holds column after column. A triangle's strip ends at its last column that
/// is not zero.
template <typename T>
class PanelFactor {
 public:
  static constexpr int kUnit = 32 / static_cast<int>(sizeof(T));  ///< rows; the last unit is padded by zeros
  static constexpr int kStrip = 3;                                ///< units
  using Numbers = Eigen::Matrix<T, Eigen::Dynamic, 1>;
  struct Panel {
    int first_column, width;
    int row_begin, row_count;                 ///< in rows(), below the triangle
    std::size_t triangle_begin, below_begin;  ///< in the values
  };

  /// Reads the factor. @param scale of its rows, #V.
  /// @param halves stores the values in half precision, with relative errors of 5e-4.
  void set(const PositiveDefiniteSolver& solver, const Numbers& scale, bool halves);

  const std::vector<Panel>& panels() const { return panels_; }
  const int* rows() const { return rows_.data(); }
  /// In units of kUnit numbers, aligned to 32 bytes, or 16 those in half precision. One of both is null.
  const T* values() const { return halves_.empty() ? values_.data()->lane : nullptr; }
  const std::uint16_t* halves() const { return halves_.empty() ? nullptr : halves_.data()->lane; }
  /// Largest width and row count of a panel, in whole strips.
  int largest() const { return largest_; }

 private:
  using Block = Eigen::Map<Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>>;
  template <typename Number>
  struct alignas(kUnit * sizeof(Number)) Unit {
    Number lane[kUnit];
  };

  void append(const Supernode& node, int first, int width, const Numbers& scale, bool halves);
  void appendBlock(const Block& block, bool is_triangle, bool halves);

  std::vector<Panel> panels_;
  std::vector<int> rows_;
  std::vector<Unit<T>> values_;
  std::vector<Unit<std::uint16_t>> halves_;
  int largest_ = 0;
  std::vector<T> triangle_, inverse_, below_;  ///< of a panel
};

}  // namespace softbody
