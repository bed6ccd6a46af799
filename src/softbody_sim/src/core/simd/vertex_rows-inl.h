// Vertices as rows (x, y, z, 0), loaded and added as whole rows of 128 bits (float) or 256 bits (double) and
// transposed in registers. This is much faster than gather instructions. `rows` holds the offsets of the
// rows, four times the vertex. Included once per vector width (Highway).
#if defined(SOFTBODY_VERTEX_ROWS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SOFTBODY_VERTEX_ROWS_INL_H_
#undef SOFTBODY_VERTEX_ROWS_INL_H_
#else
#define SOFTBODY_VERTEX_ROWS_INL_H_
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace softbody::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class V>
struct Vec3 {
  V x, y, z;
};

template <class D>
constexpr std::size_t bytesOf() {
  return hn::MaxLanes(D()) * sizeof(hn::TFromD<D>);
}

/// One 128-bit block from each of the rows `rows[0], rows[stride], ...`, at `offset` in the row.
template <class D, typename T = hn::TFromD<D>>
HWY_INLINE hn::Vec<D> loadBlocks(D d, const T* base, const int* rows, int stride, int offset) {
  if constexpr (bytesOf<D>() == 16) {
    return hn::LoadU(d, base + rows[0] + offset);
  } else {
    const hn::Half<D> half;
    constexpr auto blocks = static_cast<std::ptrdiff_t>(bytesOf<D>() / 32);
    return hn::Combine(d, loadBlocks(half, base, rows + blocks * stride, stride, offset),
                       loadBlocks(half, base, rows, stride, offset));
  }
}

template <class D, class V, typename T = hn::TFromD<D>>
HWY_INLINE void addBlocks(D d, V v, T* base, const int* rows, int stride, int offset) {
  if constexpr (bytesOf<D>() == 16) {
    T* row = base + rows[0] + offset;
    hn::StoreU(hn::Add(hn::LoadU(d, row), v), d, row);
  } else {
    const hn::Half<D> half;
    constexpr auto blocks = static_cast<std::ptrdiff_t>(bytesOf<D>() / 32);
    addBlocks(half, hn::LowerHalf(half, v), base, rows, stride, offset);
    addBlocks(half, hn::UpperHalf(half, v), base, rows + blocks * stride, stride, offset);
  }
}

/// The x, y and z vectors of the rows[0 .. lanes).
template <class D>
HWY_INLINE Vec3<hn::Vec<D>> loadRows(D d, const float* base, const int* rows) {
  const hn::Repartition<double, D> d64;
  const auto r0 = loadBlocks(d, base, rows, 4, 0), r1 = loadBlocks(d, base, rows + 1, 4, 0);
  const auto r2 = loadBlocks(d, base, rows + 2, 4, 0), r3 = loadBlocks(d, base, rows + 3, 4, 0);
  const auto xy01 = hn::BitCast(d64, hn::InterleaveLower(d, r0, r1));
  const auto xy23 = hn::BitCast(d64, hn::InterleaveLower(d, r2, r3));
  const auto z01 = hn::BitCast(d64, hn::InterleaveUpper(d, r0, r1));
  const auto z23 = hn::BitCast(d64, hn::InterleaveUpper(d, r2, r3));
  return {hn::BitCast(d, hn::InterleaveLower(d64, xy01, xy23)),
          hn::BitCast(d, hn::InterleaveUpper(d64, xy01, xy23)),
          hn::BitCast(d, hn::InterleaveLower(d64, z01, z23))};
}

template <class D>
HWY_INLINE Vec3<hn::Vec<D>> loadRows(D d, const double* base, const int* rows) {
  const auto xy0 = loadBlocks(d, base, rows, 2, 0), xy1 = loadBlocks(d, base, rows + 1, 2, 0);
  const auto z0 = loadBlocks(d, base, rows, 2, 2), z1 = loadBlocks(d, base, rows + 1, 2, 2);
  return {hn::InterleaveLower(d, xy0, xy1), hn::InterleaveUpper(d, xy0, xy1), hn::InterleaveLower(d, z0, z1)};
}

/// Adds x, y and z vectors to the rows[0 .. lanes), one row after the other: a vertex may occur twice.
template <class D, class V>
HWY_INLINE void addRows(D d, const Vec3<V>& v, float* base, const int* rows) {
  const hn::Repartition<double, D> d64;
  const auto zero = hn::Zero(d);
  const auto xy01 = hn::BitCast(d64, hn::InterleaveLower(d, v.x, v.y));
  const auto xy23 = hn::BitCast(d64, hn::InterleaveUpper(d, v.x, v.y));
  const auto z01 = hn::BitCast(d64, hn::InterleaveLower(d, v.z, zero));
  const auto z23 = hn::BitCast(d64, hn::InterleaveUpper(d, v.z, zero));
  addBlocks(d, hn::BitCast(d, hn::InterleaveLower(d64, xy01, z01)), base, rows, 4, 0);
  addBlocks(d, hn::BitCast(d, hn::InterleaveUpper(d64, xy01, z01)), base, rows + 1, 4, 0);
  addBlocks(d, hn::BitCast(d, hn::InterleaveLower(d64, xy23, z23)), base, rows + 2, 4, 0);
  addBlocks(d, hn::BitCast(d, hn::InterleaveUpper(d64, xy23, z23)), base, rows + 3, 4, 0);
}

template <class D, class V>
HWY_INLINE void addRows(D d, const Vec3<V>& v, double* base, const int* rows) {
  const auto zero = hn::Zero(d);
  addBlocks(d, hn::InterleaveLower(d, v.x, v.y), base, rows, 2, 0);
  addBlocks(d, hn::InterleaveUpper(d, v.x, v.y), base, rows + 1, 2, 0);
  addBlocks(d, hn::InterleaveLower(d, v.z, zero), base, rows, 2, 2);
  addBlocks(d, hn::InterleaveUpper(d, v.z, zero), base, rows + 1, 2, 2);
}

}  // namespace softbody::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
