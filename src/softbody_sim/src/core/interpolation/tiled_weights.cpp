#include "softbody_sim/interpolation/tiled_weights.h"

#include <stdexcept>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "interpolation/tiled_weights.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace softbody::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Lanes = hn::CappedTag<float, TiledWeights::kTileRows / 2>;
constexpr Lanes kLanes;

/// Two vectors of rows at a time: eight sums fill the multiply-adders' latency.
/// @param out of the first row; the columns are `stride` apart.
void multiplyRows(const float* weights, Eigen::Index columns, const float* values, Eigen::Index stride,
                  float* out) {
  const std::size_t n = hn::Lanes(kLanes);
  hn::Vec<Lanes> x0 = hn::Zero(kLanes), y0 = x0, z0 = x0, w0 = x0, x1 = x0, y1 = x0, z1 = x0, w1 = x0;
  for (Eigen::Index c = 0; c < columns; ++c, weights += TiledWeights::kTileRows, values += 4) {
    const auto a = hn::LoadU(kLanes, weights), b = hn::LoadU(kLanes, weights + n);
    const auto x = hn::Set(kLanes, values[0]), y = hn::Set(kLanes, values[1]);
    const auto z = hn::Set(kLanes, values[2]), w = hn::Set(kLanes, values[3]);
    x0 = hn::MulAdd(a, x, x0);
    x1 = hn::MulAdd(b, x, x1);
    y0 = hn::MulAdd(a, y, y0);
    y1 = hn::MulAdd(b, y, y1);
    z0 = hn::MulAdd(a, z, z0);
    z1 = hn::MulAdd(b, z, z1);
    w0 = hn::MulAdd(a, w, w0);
    w1 = hn::MulAdd(b, w, w1);
  }
  const hn::Vec<Lanes> sums[4][2] = {{x0, x1}, {y0, y1}, {z0, z1}, {w0, w1}};
  for (Eigen::Index k = 0; k < 4; ++k) {
    hn::StoreU(sums[k][0], kLanes, out + k * stride);
    hn::StoreU(sums[k][1], kLanes, out + k * stride + n);
  }
}

}  // namespace

void multiplyTiles(const float* tiles, Eigen::Index padded_rows, Eigen::Index columns, const float* values,
                   float* products) {
  const auto step = static_cast<Eigen::Index>(2 * hn::Lanes(kLanes));
  for (Eigen::Index row = 0; row < padded_rows; row += step) {
    const Eigen::Index within = row % TiledWeights::kTileRows;
    multiplyRows(tiles + (row - within) * columns + within, columns, values, padded_rows, products + row);
  }
}

}  // namespace softbody::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace softbody {
HWY_EXPORT(multiplyTiles);

void TiledWeights::append(const Eigen::Ref<const Eigen::RowVectorXd>& row) {
  const Eigen::Index within = rows_ % kTileRows;
  if (within == 0) tiles_.resize(tiles_.size() + static_cast<std::size_t>(columns_ * kTileRows), 0.0f);
  float* tile = &tiles_[static_cast<std::size_t>((rows_ - within) * columns_)];
  for (Eigen::Index c = 0; c < columns_; ++c) tile[c * kTileRows + within] = static_cast<float>(row[c]);
  ++rows_;
}

void TiledWeights::multiply(const Values& values, Products* products) const {
  if (values.rows() != columns_)
    throw std::invalid_argument("TiledWeights: values must have one row per column");
  const Eigen::Index padded = (rows_ + kTileRows - 1) / kTileRows * kTileRows;
  products->resize(padded, 4);
  HWY_DYNAMIC_DISPATCH(multiplyTiles)(tiles_.data(), padded, columns_, values.data(), products->data());
}
}  // namespace softbody
#endif
