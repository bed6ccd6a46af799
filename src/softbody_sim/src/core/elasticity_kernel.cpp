#include "core/elasticity_kernel.h"

#include "core/rotation.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/elasticity_kernel.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <hwy/highway.h>

#include "core/vertex_rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace softbody::HWY_NAMESPACE {
namespace {

/// By columns.
template <class V>
struct Mat3 {
  Vec3<V> c0, c1, c2;
};

template <class V>
HWY_INLINE Vec3<V> minus(const Vec3<V>& a, const Vec3<V>& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}

template <class V>
HWY_INLINE Vec3<V> negatedSum(const Vec3<V>& a, const Vec3<V>& b, const Vec3<V>& c) {
  return {hn::Neg(hn::Add(hn::Add(a.x, b.x), c.x)), hn::Neg(hn::Add(hn::Add(a.y, b.y), c.y)),
          hn::Neg(hn::Add(hn::Add(a.z, b.z), c.z))};
}

template <class V>
HWY_INLINE Vec3<V> cross(const Vec3<V>& a, const Vec3<V>& b) {
  return {hn::MulSub(a.y, b.z, hn::Mul(a.z, b.y)), hn::MulSub(a.z, b.x, hn::Mul(a.x, b.z)),
          hn::MulSub(a.x, b.y, hn::Mul(a.y, b.x))};
}

template <class V>
HWY_INLINE V dot(const Vec3<V>& a, const Vec3<V>& b) {
  return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}

/// a M.c0 + b M.c1 + c M.c2
template <class V>
HWY_INLINE Vec3<V> combine(const Mat3<V>& M, V a, V b, V c) {
  return {hn::MulAdd(M.c0.x, a, hn::MulAdd(M.c1.x, b, hn::Mul(M.c2.x, c))),
          hn::MulAdd(M.c0.y, a, hn::MulAdd(M.c1.y, b, hn::Mul(M.c2.y, c))),
          hn::MulAdd(M.c0.z, a, hn::MulAdd(M.c1.z, b, hn::Mul(M.c2.z, c)))};
}

/// a u + b v
template <class V>
HWY_INLINE Vec3<V> blend(V a, const Vec3<V>& u, V b, const Vec3<V>& v) {
  return {hn::MulAdd(a, u.x, hn::Mul(b, v.x)), hn::MulAdd(a, u.y, hn::Mul(b, v.y)),
          hn::MulAdd(a, u.z, hn::Mul(b, v.z))};
}

/// The lanes whose rotation is nearly not unique, one by one.
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_NOINLINE void extractOneByOne(D d, hn::Mask<D> wanted, const Mat3<V>& F, Mat3<V>* R, V* trace) {
  constexpr std::size_t kMost = 16;
  HWY_ALIGN T f[9][kMost], r[9][kMost], s[kMost], lanes[kMost];
  const V* columns = &F.c0.x;
  V* result = &R->c0.x;
  for (int k = 0; k < 9; ++k) {
    hn::Store(columns[k], d, f[k]);
    hn::Store(result[k], d, r[k]);
  }
  hn::Store(*trace, d, s);
  hn::Store(hn::IfThenElse(wanted, hn::Set(d, T{1}), hn::Zero(d)), d, lanes);
  for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane) {
    if (lanes[lane] == T{0}) continue;
    Eigen::Matrix3d one, rotation;
    for (int k = 0; k < 9; ++k) one(k) = static_cast<double>(f[k][lane]);
    s[lane] = static_cast<T>(extractRotation(one, &rotation));
    for (int k = 0; k < 9; ++k) r[k][lane] = static_cast<T>(rotation(k));
  }
  for (int k = 0; k < 9; ++k) result[k] = hn::Load(d, r[k]);
  *trace = hn::Load(d, s);
}

/// extractRotation() for a vector of matrices. @return tr(R^T F).
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_INLINE V extractRotations(D d, const Mat3<V>& F, Mat3<V>* R) {
  const Mat3<V> C{cross(F.c1, F.c2), cross(F.c2, F.c0), cross(F.c0, F.c1)};
  const V det8 = hn::Mul(hn::Set(d, T{8}), dot(F.c0, C.c0));
  const V f00 = dot(F.c0, F.c0), f11 = dot(F.c1, F.c1), f22 = dot(F.c2, F.c2);
  const V squared_norm = hn::Add(hn::Add(f00, f11), f22);
  const V cofactor_term =
      hn::Mul(hn::Set(d, T{4}), hn::Add(hn::Add(dot(C.c0, C.c0), dot(C.c1, C.c1)), dot(C.c2, C.c2)));
  const V four = hn::Set(d, T{4});
  // The error after a step is about a quarter of the square of the step.
  const V small = hn::Set(d, sizeof(T) == 4 ? T(3e-4) : T(2e-8));
  V s = hn::Sqrt(hn::Mul(hn::Set(d, T{3}), squared_norm));
  V slope, step;
  constexpr int kMaxIterations = 8;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    const V gap = hn::MulSub(s, s, squared_norm);
    slope = hn::MulSub(hn::Mul(four, s), gap, det8);
    step = hn::Div(hn::MulSub(gap, gap, hn::MulAdd(det8, s, cofactor_term)), slope);
    s = hn::Sub(s, step);
    if (hn::AllTrue(d, hn::Lt(hn::Abs(step), hn::Mul(small, s)))) break;
  }
  // kappa + |F|^2 = (s^2 + |F|^2) / 2 and zeta = kappa s - det F, both doubled.
  const V kappa2 = hn::MulSub(s, s, squared_norm);
  const V zeta2 = hn::NegMulAdd(hn::Set(d, T(0.25)), det8, hn::Mul(kappa2, s));
  const V scale = hn::Div(hn::Set(d, T{1}), zeta2);
  const V s2 = hn::Mul(hn::Add(s, s), scale), minus2 = hn::Mul(hn::Set(d, T{-2}), scale);
  const V diagonal = hn::Mul(hn::MulAdd(s, s, squared_norm), scale);
  const V f01 = hn::Mul(minus2, dot(F.c0, F.c1)), f02 = hn::Mul(minus2, dot(F.c0, F.c2)),
          f12 = hn::Mul(minus2, dot(F.c1, F.c2));
  const auto column = [&](V a, V b, V c, const Vec3<V>& cofactors) {
    const Vec3<V> v = combine(F, a, b, c);
    return Vec3<V>{hn::MulAdd(s2, cofactors.x, v.x), hn::MulAdd(s2, cofactors.y, v.y),
                   hn::MulAdd(s2, cofactors.z, v.z)};
  };
  R->c0 = column(hn::MulAdd(minus2, f00, diagonal), f01, f02, C.c0);
  R->c1 = column(f01, hn::MulAdd(minus2, f11, diagonal), f12, C.c1);
  R->c2 = column(f02, f12, hn::MulAdd(minus2, f22, diagonal), C.c2);

  // As in extractRotation(); the comparison is false for NaN, too.
  const auto sure = hn::And(hn::Gt(slope, hn::Mul(hn::Set(d, T(1e-2)), hn::Mul(squared_norm, s))),
                            hn::Lt(hn::Abs(step), hn::Mul(small, s)));
  if (HWY_UNLIKELY(!hn::AllTrue(d, sure))) extractOneByOne(d, hn::Not(sure), F, R, &s);
  return s;
}

template <typename T>
double corotated(const TetBlock<T>* blocks, std::size_t count, T mu_in, T lambda_in, const T* x,
                 T* gradient) {
  const hn::CappedTag<T, TetBlock<T>::kLanes> d;
  using V = hn::Vec<decltype(d)>;
  const V mu = hn::Set(d, mu_in), half_lambda = hn::Set(d, T(0.5) * lambda_in), three = hn::Set(d, T{3});
  double energy = 0.0;
  for (std::size_t b = 0; b < count; ++b) {
    const TetBlock<T>& block = blocks[b];
    V block_energy = hn::Zero(d);
    for (std::size_t lane = 0; lane < TetBlock<T>::kLanes; lane += hn::Lanes(d)) {
      const auto m = [&](int k) { return hn::Load(d, block.inverse_edges[k] + lane); };
      const Vec3<V> origin = loadRows(d, x, block.vertices[0] + lane);
      const Mat3<V> edges{minus(loadRows(d, x, block.vertices[1] + lane), origin),
                          minus(loadRows(d, x, block.vertices[2] + lane), origin),
                          minus(loadRows(d, x, block.vertices[3] + lane), origin)};
      const Mat3<V> F{combine(edges, m(0), m(1), m(2)), combine(edges, m(3), m(4), m(5)),
                      combine(edges, m(6), m(7), m(8))};
      Mat3<V> R;
      const V dilation = hn::Sub(extractRotations(d, F, &R), three);
      const Mat3<V> strain{minus(F.c0, R.c0), minus(F.c1, R.c1), minus(F.c2, R.c2)};

      const V volume = hn::Load(d, block.volume + lane);
      const V stiffness = hn::Mul(mu, volume), pressure = hn::Mul(hn::Mul(half_lambda, volume), dilation);
      const V squared =
          hn::Add(hn::Add(dot(strain.c0, strain.c0), dot(strain.c1, strain.c1)), dot(strain.c2, strain.c2));
      block_energy = hn::Add(block_energy, hn::MulAdd(stiffness, squared, hn::Mul(pressure, dilation)));

      const V mu2 = hn::Add(stiffness, stiffness), lambda_dilation = hn::Add(pressure, pressure);
      const Mat3<V> stress{blend(mu2, strain.c0, lambda_dilation, R.c0),
                           blend(mu2, strain.c1, lambda_dilation, R.c1),
                           blend(mu2, strain.c2, lambda_dilation, R.c2)};
      const Vec3<V> f1 = combine(stress, m(0), m(3), m(6)), f2 = combine(stress, m(1), m(4), m(7)),
                    f3 = combine(stress, m(2), m(5), m(8));
      addRows(d, f1, gradient, block.vertices[1] + lane);
      addRows(d, f2, gradient, block.vertices[2] + lane);
      addRows(d, f3, gradient, block.vertices[3] + lane);
      addRows(d, negatedSum(f1, f2, f3), gradient, block.vertices[0] + lane);
    }
    energy += static_cast<double>(hn::GetLane(hn::SumOfLanes(d, block_energy)));
  }
  return energy;
}

}  // namespace

double corotatedFloat(const TetBlock<float>* blocks, std::size_t count, float mu, float lambda,
                      const float* x, float* gradient) {
  return corotated(blocks, count, mu, lambda, x, gradient);
}

double corotatedDouble(const TetBlock<double>* blocks, std::size_t count, double mu, double lambda,
                       const double* x, double* gradient) {
  return corotated(blocks, count, mu, lambda, x, gradient);
}

}  // namespace softbody::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "core/simd_dispatch.h"

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
