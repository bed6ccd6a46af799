#include "elasticity/elasticity_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "elasticity/elasticity_kernel.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <hwy/highway.h>

#include "elasticity/corotated-inl.h"

HWY_BEFORE_NAMESPACE();
namespace softbody::HWY_NAMESPACE {
namespace {

template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_INLINE Deformation<V> loadDeformation(D d, const TetBlock<T>& block, std::size_t lane, const T* x) {
  const auto m = [&](int k) { return hn::Load(d, block.inverse_edges[k] + lane); };
  const Vec3<V> origin = loadRows(d, x, block.corners[0] + lane);
  const Mat3<V> edges{minus(loadRows(d, x, block.corners[1] + lane), origin),
                      minus(loadRows(d, x, block.corners[2] + lane), origin),
                      minus(loadRows(d, x, block.corners[3] + lane), origin)};
  return deformation(d, Mat3<V>{times(m(0), edges.c0), combine(edges.c0, edges.c1, m(1), m(2)),
                                combine(edges, m(3), m(4), m(5))});
}

template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_INLINE void addForces(D d, const TetBlock<T>& block, std::size_t lane, const Mat3<V>& stress,
                          T* gradient) {
  const auto m = [&](int k) { return hn::Load(d, block.inverse_edges[k] + lane); };
  const Vec3<V> f1 = combine(stress, m(0), m(1), m(3)), f2 = combine(stress.c1, stress.c2, m(2), m(4)),
                f3 = times(m(5), stress.c2);
  addRows(d, f1, gradient, block.corners[1] + lane);
  addRows(d, f2, gradient, block.corners[2] + lane);
  addRows(d, f3, gradient, block.corners[3] + lane);
  addRows(d, negatedSum(f1, f2, f3), gradient, block.corners[0] + lane);
}

/// kVectors vectors of tets at once, starting at lane `first` counted over all blocks.
template <std::size_t kVectors, class D, typename T = hn::TFromD<D>>
HWY_INLINE double addVectors(D d, const TetBlock<T>* blocks, std::size_t first, const T* x, T* gradient) {
  using V = hn::Vec<D>;
  constexpr std::size_t kLanes = TetBlock<T>::kLanes;
  const std::size_t lanes = hn::Lanes(d);
  Deformation<V> deformations[kVectors];
  for (std::size_t k = 0, tet = first; k < kVectors; ++k, tet += lanes) {
    deformations[k] = loadDeformation(d, blocks[tet / kLanes], tet % kLanes, x);
  }
  findTraces<kVectors>(d, deformations);
  V sum = hn::Zero(d);
  for (std::size_t k = 0, tet = first; k < kVectors; ++k, tet += lanes) {
    const TetBlock<T>& block = blocks[tet / kLanes];
    const V shear = hn::Load(d, block.shear + tet % kLanes), bulk = hn::Load(d, block.bulk + tet % kLanes);
    const Response<V> response = respond(d, shear, bulk, deformations[k]);
    addForces(d, block, tet % kLanes, response.stress, gradient);
    sum = hn::Add(sum, response.energy);
  }
  return static_cast<double>(hn::GetLane(hn::SumOfLanes(d, sum)));
}

template <typename T>
double corotated(const TetBlock<T>* blocks, std::size_t count, const T* x, T* gradient) {
  const hn::CappedTag<T, TetBlock<T>::kLanes> d;
  const std::size_t lanes = hn::Lanes(d), end = count * TetBlock<T>::kLanes;
  double energy = 0.0;
  std::size_t first = 0;
  for (; first + 4 * lanes <= end; first += 4 * lanes) energy += addVectors<4>(d, blocks, first, x, gradient);
  const std::size_t left = (end - first) / lanes;
  if (left == 3) energy += addVectors<3>(d, blocks, first, x, gradient);
  if (left == 2) energy += addVectors<2>(d, blocks, first, x, gradient);
  if (left == 1) energy += addVectors<1>(d, blocks, first, x, gradient);
  return energy;
}

}  // namespace

double corotatedFloat(const TetBlock<float>* blocks, std::size_t count, const float* x, float* gradient) {
  return corotated(blocks, count, x, gradient);
}

double corotatedDouble(const TetBlock<double>* blocks, std::size_t count, const double* x, double* gradient) {
  return corotated(blocks, count, x, gradient);
}

}  // namespace softbody::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/simd_dispatch.h"

namespace softbody {

HWY_EXPORT(corotatedFloat);
HWY_EXPORT(corotatedDouble);

template <>
ElasticityKernel<float> elasticityKernel<float>(Simd simd) {
  return HWY_DISPATCH_TABLE(corotatedFloat)[dispatchIndex(simd)];
}

template <>
ElasticityKernel<double> elasticityKernel<double>(Simd simd) {
  return HWY_DISPATCH_TABLE(corotatedDouble)[dispatchIndex(simd)];
}

}  // namespace softbody
#endif
