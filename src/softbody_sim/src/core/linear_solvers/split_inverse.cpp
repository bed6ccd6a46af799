#include "linear_solvers/split_inverse.h"

#include <algorithm>

namespace softbody {

template <typename T>
SplitInverse<T>::Block::Block(int row_count, int column_count)
    : rows(row_count),
      columns(column_count),
      lanes((row_count + 7) / 8),
      values(static_cast<std::size_t>(lanes) * static_cast<std::size_t>(column_count), Lanes{}) {}

template <typename T>
template <typename Values>
void SplitInverse<T>::Block::set(int first_column, const Values& block) {
  if (rows == 0) return;
  for (Eigen::Index j = 0; j < block.cols(); ++j) {
    T* column = values[static_cast<std::size_t>(first_column + j) * static_cast<std::size_t>(lanes)].lane;
    Eigen::Map<Eigen::Matrix<T, Eigen::Dynamic, 1>>(column, rows) = block.col(j);
  }
}

template <typename T>
SplitInverse<T>::SplitInverse(const Eigen::SparseMatrix<double>& lower, Simd simd)
    : dissection_(dissect(lower)),
      places_(dissection_.order.size()),
      result_rows_(dissection_.order.size()),
      product_(denseProduct<T>(simd)),
      separator_(dissection_.separator, static_cast<int>(lower.rows())),
      first_(dissection_.first, dissection_.first + dissection_.separator),
      second_(dissection_.second, dissection_.separator + dissection_.second),
      inverse_(lower.rows(), lower.cols()),
      coupling_(dissection_.separator, std::max(dissection_.first, dissection_.second)),
      separator_factor_(dissection_.separator),
      gathered_(Rows<T>::Zero(lower.rows(), 4)),
      results_(Rows<T>::Zero(8 * (first_.lanes + separator_.lanes + second_.lanes), 4)) {
  const int after_first = dissection_.first + dissection_.separator;
  for (int k = 0; k < static_cast<int>(dissection_.order.size()); ++k) {
    const auto vertex = static_cast<std::size_t>(dissection_.order[static_cast<std::size_t>(k)]);
    places_[vertex] = k;
    // The results of each block start at whole Lanes.
    if (k < dissection_.first)
      result_rows_[vertex] = k;
    else if (k < after_first)
      result_rows_[vertex] = 8 * first_.lanes + k - dissection_.first;
    else
      result_rows_[vertex] = 8 * (first_.lanes + separator_.lanes) + k - after_first;
  }
}

template <typename T>
bool SplitInverse<T>::split() {
  const int first = dissection_.first, separator = dissection_.separator;
  separator_.set(0, inverse_.middleRows(first, separator));
  separator_factor_.compute(inverse_.block(first, first, separator, separator));
  if (separator > 0 && separator_factor_.info() != Eigen::Success) return false;
  splitPart(0, 0, first, &first_);
  splitPart(first + separator, separator, 0, &second_);
  return true;
}

/// With C = A^-1, -A_PP^-1 A_PS = C_PS C_SS^-1 =: G and A_PP^-1 = C_PP - G C_SP.
template <typename T>
void SplitInverse<T>::splitPart(int begin, int first_own_column, int first_separator_column, Block* part) {
  const int first = dissection_.first, separator = dissection_.separator, size = part->rows;
  auto coupling = coupling_.leftCols(size);  // G^T
  coupling = inverse_.block(first, begin, separator, size);
  separator_factor_.solveInPlace(coupling);
  part->set(first_separator_column, coupling.transpose());
  inverse_.block(begin, begin, size, size) -=
      inverse_.block(begin, first, size, separator).lazyProduct(coupling);
  part->set(first_own_column, inverse_.block(begin, begin, size, size));
}

template <typename T>
void SplitInverse<T>::multiply(const Block& block, int first_row, int result_row) {
  if (block.rows == 0) return;
  product_(block.values.data()->lane, block.columns, 8 * block.lanes, gathered_.data() + 4 * first_row,
           results_.data() + 4 * result_row);
}

template <typename T>
void SplitInverse<T>::multiply(const Rows<T>& B, Rows<T>* X) {
  const int first = dissection_.first, separator = dissection_.separator;
  const int separator_results = 8 * first_.lanes;
  scatterRows(B.data(), places_.data(), places_.size(), gathered_.data());
  multiply(separator_, 0, separator_results);
  gathered_.middleRows(first, separator) = results_.middleRows(separator_results, separator);
  multiply(first_, 0, 0);
  multiply(second_, first, separator_results + 8 * separator_.lanes);
  gatherRows(results_.data(), result_rows_.data(), result_rows_.size(), X->data());
}

template class SplitInverse<float>;
template class SplitInverse<double>;

}  // namespace softbody
