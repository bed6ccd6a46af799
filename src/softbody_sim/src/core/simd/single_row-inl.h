// A vertex as a row (x, y, z, 0) in registers. Included once per vector width (Highway).
#if defined(SOFTBODY_SINGLE_ROW_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SOFTBODY_SINGLE_ROW_INL_H_
#undef SOFTBODY_SINGLE_ROW_INL_H_
#else
#define SOFTBODY_SINGLE_ROW_INL_H_
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace softbody::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <typename T>
struct Row {
  using D = hn::CappedTag<T, 4>;
  static constexpr int kLanes = static_cast<int>(hn::MaxLanes(D()));
  static constexpr int kParts = 4 / kLanes;
  hn::Vec<D> part[kParts];

  static HWY_INLINE Row zero() {
    Row r;
    for (int k = 0; k < kParts; ++k) r.part[k] = hn::Zero(D());
    return r;
  }
  static HWY_INLINE Row load(const T* row) {
    Row r;
    for (int k = 0; k < kParts; ++k) r.part[k] = hn::LoadU(D(), row + k * kLanes);
    return r;
  }
  HWY_INLINE void store(T* row) const {
    for (int k = 0; k < kParts; ++k) hn::StoreU(part[k], D(), row + k * kLanes);
  }
  HWY_INLINE Row times(T factor) const {
    Row r;
    for (int k = 0; k < kParts; ++k) r.part[k] = hn::Mul(part[k], hn::Set(D(), factor));
    return r;
  }
  HWY_INLINE Row plus(const Row& b) const {
    Row r;
    for (int k = 0; k < kParts; ++k) r.part[k] = hn::Add(part[k], b.part[k]);
    return r;
  }
  HWY_INLINE Row minus(const Row& b) const {
    Row r;
    for (int k = 0; k < kParts; ++k) r.part[k] = hn::Sub(part[k], b.part[k]);
    return r;
  }
  HWY_INLINE Row plusProduct(T factor, const Row& b) const {
    Row r;
    for (int k = 0; k < kParts; ++k) r.part[k] = hn::MulAdd(hn::Set(D(), factor), b.part[k], part[k]);
    return r;
  }
  HWY_INLINE Row minusProduct(T factor, const Row& b) const {
    Row r;
    for (int k = 0; k < kParts; ++k) r.part[k] = hn::NegMulAdd(hn::Set(D(), factor), b.part[k], part[k]);
    return r;
  }
  HWY_INLINE Row plusProduct(const Row& a, const Row& b) const {
    Row r;
    for (int k = 0; k < kParts; ++k) r.part[k] = hn::MulAdd(a.part[k], b.part[k], part[k]);
    return r;
  }
  HWY_INLINE T sum() const {
    auto total = part[0];
    for (int k = 1; k < kParts; ++k) total = hn::Add(total, part[k]);
    return hn::GetLane(hn::SumOfLanes(D(), total));
  }
  HWY_INLINE T dot(const Row& b) const { return zero().plusProduct(*this, b).sum(); }
};

}  // namespace softbody::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
