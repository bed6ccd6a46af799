#include "elasticity/smoothing_kernel.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "elasticity/smoothing_kernel.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <hwy/highway.h>

#include "elasticity/corotated-inl.h"
#include "simd/single_row-inl.h"

HWY_BEFORE_NAMESPACE();
namespace softbody::HWY_NAMESPACE {
namespace {

/// F_p = sum_i x_i g_i^T, each column in a row of four numbers; the identity for padding patches.
template <typename T>
HWY_INLINE void findDeformations(const PatchView<T>& patches, const T* x, T* deformations) {
  for (std::size_t v = 0; v < patches.count; ++v) {
    Row<T> columns[3] = {Row<T>::zero(), Row<T>::zero(), Row<T>::zero()};
    for (int e = patches.first[v]; e < patches.first[v + 1]; ++e) {
      const Row<T> point = Row<T>::load(x + patches.rows[e]);
      for (int k = 0; k < 3; ++k) columns[k] = columns[k].plusProduct(patches.gradients[3 * e + k], point);
    }
    for (int k = 0; k < 3; ++k) columns[k].store(deformations + patches.columns[v] + 4 * k);
  }
  for (std::size_t v = patches.count; v < patches.padded_count; ++v) {
    for (int k = 0; k < 12; ++k) deformations[patches.columns[v] + k] = k % 5 == 0 ? T{1} : T{0};
  }
}

template <class D, typename T = hn::TFromD<D>>
HWY_INLINE Mat3<hn::Vec<D>> loadColumns(D d, const T* base, const int* columns) {
  return {loadRows(d, base, columns), loadRows(d, base + 4, columns), loadRows(d, base + 8, columns)};
}

/// Energy [J]; sets stress times volume.
template <typename T>
HWY_INLINE double findStresses(const PatchView<T>& patches, const T* deformations, T* stresses) {
  const hn::CappedTag<T, 16> d;
  std::fill_n(stresses, 12 * patches.padded_count, T{0});
  double energy = 0.0;
  for (std::size_t v = 0; v < patches.padded_count; v += hn::Lanes(d)) {
    const int* columns = patches.columns + v;
    Deformation<hn::Vec<decltype(d)>> one[1] = {deformation(d, loadColumns(d, deformations, columns))};
    findTraces<1>(d, one);
    const auto response = respond(d, hn::LoadU(d, patches.shear + v), hn::LoadU(d, patches.bulk + v), one[0]);
    addRows(d, response.stress.c0, stresses, columns);
    addRows(d, response.stress.c1, stresses + 4, columns);
    addRows(d, response.stress.c2, stresses + 8, columns);
    energy += static_cast<double>(hn::GetLane(hn::SumOfLanes(d, response.energy)));
  }
  return energy;
}

template <typename T>
HWY_INLINE void addForces(const PatchView<T>& patches, const T* stresses, T* gradient) {
  for (std::size_t v = 0; v < patches.vertex_count; ++v) {
    Row<T> force = Row<T>::load(gradient + 4 * v);
    for (int e = patches.vertex_first[v]; e < patches.vertex_first[v + 1]; ++e) {
      const T* stress = stresses + 3 * patches.vertex_rows[e];
      for (int k = 0; k < 3; ++k)
        force = force.plusProduct(patches.vertex_gradients[3 * e + k], Row<T>::load(stress + 4 * k));
    }
    force.store(gradient + 4 * v);
  }
}

template <typename T>
double smoothed(const PatchView<T>& patches, const T* x, T* deformations, T* stresses, T* gradient) {
  findDeformations(patches, x, deformations);
  const double energy = findStresses(patches, deformations, stresses);
  addForces(patches, stresses, gradient);
  return energy;
}

}  // namespace

double smoothedFloat(const PatchView<float>& patches, const float* x, float* deformations, float* stresses,
                     float* gradient) {
  return smoothed(patches, x, deformations, stresses, gradient);
}

double smoothedDouble(const PatchView<double>& patches, const double* x, double* deformations,
                      double* stresses, double* gradient) {
  return smoothed(patches, x, deformations, stresses, gradient);
}

}  // namespace softbody::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/simd_dispatch.h"

namespace softbody {

HWY_EXPORT(smoothedFloat);
HWY_EXPORT(smoothedDouble);

template <>
SmoothingKernel<float> smoothingKernel<float>(Simd simd) {
  return HWY_DISPATCH_TABLE(smoothedFloat)[dispatchIndex(simd)];
}

template <>
SmoothingKernel<double> smoothingKernel<double>(Simd simd) {
  return HWY_DISPATCH_TABLE(smoothedDouble)[dispatchIndex(simd)];
}

}  // namespace softbody
#endif
