#include "time_step/potential_kernel.h"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "time_step/potential_kernel.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <hwy/highway.h>

#include "simd/single_row-inl.h"

HWY_BEFORE_NAMESPACE();
namespace softbody::HWY_NAMESPACE {
namespace {

template <typename T>
HWY_INLINE double setInertialTerms(const PotentialView<T>& step, const T* x, T* gradient) {
  const hn::CappedTag<T, 16> d;
  constexpr std::size_t kChunk = 256;  // length of partial sums in the precision T
  const auto half = hn::Set(d, T(0.5));
  double energy = 0.0;
  for (std::size_t begin = 0; begin < step.size; begin += kChunk) {
    auto sum = hn::Zero(d);
    const std::size_t end = begin + kChunk < step.size ? begin + kChunk : step.size;
    for (std::size_t i = begin; i < end; i += hn::Lanes(d)) {
      const auto offset = hn::Sub(hn::LoadU(d, x + i), hn::LoadU(d, step.prediction + i));
      const auto inertia = hn::LoadU(d, step.inertia + i), load = hn::LoadU(d, step.loads + i);
      const auto pull = hn::Mul(inertia, offset);
      hn::StoreU(hn::Sub(pull, load), d, gradient + i);
      sum = hn::MulAdd(hn::MulSub(half, pull, load), offset, sum);
    }
    energy += static_cast<double>(hn::GetLane(hn::SumOfLanes(d, sum)));
  }
  return energy;
}

/// Adds a target's gradient, and its energy times two, by components.
template <typename T>
HWY_INLINE void addTarget(const TargetRow<T>& target, const T* x, T* gradient, Row<T>* energy) {
  Row<T> offset = Row<T>::load(x + target.corners[0]).times(target.barycentric[0]);
  for (int k = 1; k < 4; ++k) {
    offset = offset.plusProduct(target.barycentric[k], Row<T>::load(x + target.corners[k]));
  }
  for (int k = 0; k < 4 && target.is_coupled; ++k)
    offset = offset.minusProduct(target.other_barycentric[k], Row<T>::load(x + target.other_corners[k]));
  offset = offset.minus(Row<T>::load(target.position));
  if (target.has_normal) {
    const Row<T> normal = Row<T>::load(target.normal);
    const T distance = offset.dot(normal);
    const Row<T> along = normal.times(target.one_sided ? std::min(distance, T{0}) : distance);
    offset = target.is_friction ? offset.minus(along) : along;
  }
  T hold{1};  // force relative to that of a spring that never slides
  if (target.is_friction) {
    const T length = std::sqrt(offset.dot(offset));
    if (length > target.slide) hold = target.slide / length;
  }
  const Row<T> force = offset.times(hold * target.stiffness);
  for (int k = 0; k < 4; ++k) {
    T* row = gradient + target.corners[k];
    Row<T>::load(row).plusProduct(target.barycentric[k], force).store(row);
  }
  for (int k = 0; k < 4 && target.is_coupled; ++k) {
    T* row = gradient + target.other_corners[k];
    Row<T>::load(row).minusProduct(target.other_barycentric[k], force).store(row);
  }
  *energy = energy->plusProduct(force.times(T{2} - hold), offset);
}

template <typename T>
double evaluate(const PotentialView<T>& step, const T* x, T* gradient) {
  constexpr std::size_t kChunk = 32;  // length of partial sums in the precision T
  double energy = setInertialTerms(step, x, gradient);
  for (std::size_t begin = 0; begin < step.target_count; begin += kChunk) {
    const std::size_t end = begin + kChunk < step.target_count ? begin + kChunk : step.target_count;
    Row<T> twice = Row<T>::zero();
    for (std::size_t i = begin; i < end; ++i) addTarget(step.targets[i], x, gradient, &twice);
    energy += 0.5 * static_cast<double>(twice.sum());
  }
  return energy;
}

}  // namespace

double potentialFloat(const PotentialView<float>& step, const float* x, float* gradient) {
  return evaluate(step, x, gradient);
}
double potentialDouble(const PotentialView<double>& step, const double* x, double* gradient) {
  return evaluate(step, x, gradient);
}

}  // namespace softbody::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/simd_dispatch.h"

namespace softbody {

HWY_EXPORT(potentialFloat);
HWY_EXPORT(potentialDouble);

template <>
PotentialKernel<float> potentialKernel<float>(Simd simd) {
  return HWY_DISPATCH_TABLE(potentialFloat)[dispatchIndex(simd)];
}
template <>
PotentialKernel<double> potentialKernel<double>(Simd simd) {
  return HWY_DISPATCH_TABLE(potentialDouble)[dispatchIndex(simd)];
}

}  // namespace softbody
#endif
