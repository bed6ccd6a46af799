#include "core/target_kernel.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/target_kernel.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <hwy/highway.h>

#include "core/single_row-inl.h"

HWY_BEFORE_NAMESPACE();
namespace softbody::HWY_NAMESPACE {
namespace {

template <typename T>
double addTargets(const TargetRow<T>* targets, std::size_t count, const T* x, T* gradient) {
  double energy = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const TargetRow<T>& target = targets[i];
    Row<T> offset = Row<T>::load(x + 4 * target.vertices[0]).times(target.barycentric[0]);
    for (int k = 1; k < 4; ++k) {
      offset = offset.plusProduct(target.barycentric[k], Row<T>::load(x + 4 * target.vertices[k]));
    }
    offset = offset.minus(Row<T>::load(target.position));
    Row<T> force;
    if (target.has_normal) {
      const Row<T> normal = Row<T>::load(target.normal);
      const T distance = target.one_sided ? std::min(offset.dot(normal), T(0)) : offset.dot(normal);
      force = normal.times(target.stiffness * distance);
      energy += static_cast<double>(T(0.5) * target.stiffness * distance * distance);
    } else {
      force = offset.times(target.stiffness);
      energy += static_cast<double>(T(0.5) * force.dot(offset));
    }
    for (int k = 0; k < 4; ++k) {
      T* row = gradient + 4 * target.vertices[k];
      Row<T>::load(row).plusProduct(target.barycentric[k], force).store(row);
    }
  }
  return energy;
}

}  // namespace

double targetsFloat(const TargetRow<float>* targets, std::size_t count, const float* x, float* gradient) {
  return addTargets(targets, count, x, gradient);
}
double targetsDouble(const TargetRow<double>* targets, std::size_t count, const double* x, double* gradient) {
  return addTargets(targets, count, x, gradient);
}

}  // namespace softbody::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "core/simd_dispatch.h"

namespace softbody {

HWY_EXPORT(targetsFloat);
HWY_EXPORT(targetsDouble);

template <>
TargetKernel<float> targetKernel<float>(Simd simd) {
  return HWY_DISPATCH_TABLE(targetsFloat)[dispatchIndex(simd)];
}
template <>
TargetKernel<double> targetKernel<double>(Simd simd) {
  return HWY_DISPATCH_TABLE(targetsDouble)[dispatchIndex(simd)];
}

}  // namespace softbody
#endif
