#pragma once

#include <Eigen/Core>
#include <vector>

namespace softbody {

/// A dense matrix of weights for fast products with four columns. Single precision, in tiles of 32 rows: each
/// weight is loaded once for all four columns (Highway, dispatched at run time).
class TiledWeights {
 public:
  using Values = Eigen::Matrix<float, Eigen::Dynamic, 4, Eigen::RowMajor>;
  using Products = Eigen::Matrix<float, Eigen::Dynamic, 4>;  ///< column-major, rows padded to whole tiles
  static constexpr int kTileRows = 32;

  explicit TiledWeights(Eigen::Index columns = 0) : columns_(columns) {}

  void append(const Eigen::Ref<const Eigen::RowVectorXd>& row);

  Eigen::Index rows() const { return rows_; }
  Eigen::Index columns() const { return columns_; }

  /// Weights times values; the rows beyond rows() are zero. Reuses the memory of the result if its size fits.
  /// @throw std::invalid_argument if values do not have one row per column.
  void multiply(const Values& values, Products* products) const;

 private:
  Eigen::Index columns_, rows_ = 0;
  std::vector<float> tiles_;  ///< [tile][column][row in tile]
};

}  // namespace softbody
