// The corotated material over vectors of deformation gradients. Included once per vector width (Highway).
#if defined(SOFTBODY_COROTATED_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SOFTBODY_COROTATED_INL_H_
#undef SOFTBODY_COROTATED_INL_H_
#else
#define SOFTBODY_COROTATED_INL_H_
#endif

#include <hwy/highway.h>

#include "elasticity/corotated_elasticity.h"
#include "simd/vertex_rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace softbody::HWY_NAMESPACE {

/// A matrix by columns.
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

template <class V>
HWY_INLINE Vec3<V> times(V a, const Vec3<V>& u) {
  return {hn::Mul(a, u.x), hn::Mul(a, u.y), hn::Mul(a, u.z)};
}

/// a u + b v
template <class V>
HWY_INLINE Vec3<V> combine(const Vec3<V>& u, const Vec3<V>& v, V a, V b) {
  return {hn::MulAdd(u.x, a, hn::Mul(v.x, b)), hn::MulAdd(u.y, a, hn::Mul(v.y, b)),
          hn::MulAdd(u.z, a, hn::Mul(v.z, b))};
}

/// a M.c0 + b M.c1 + c M.c2
template <class V>
HWY_INLINE Vec3<V> combine(const Mat3<V>& M, V a, V b, V c) {
  return {hn::MulAdd(M.c0.x, a, hn::MulAdd(M.c1.x, b, hn::Mul(M.c2.x, c))),
          hn::MulAdd(M.c0.y, a, hn::MulAdd(M.c1.y, b, hn::Mul(M.c2.y, c))),
          hn::MulAdd(M.c0.z, a, hn::MulAdd(M.c1.z, b, hn::Mul(M.c2.z, c)))};
}

/// A symmetric matrix by its upper triangle.
template <class V>
struct Symmetric3 {
  V m00, m01, m02, m11, m12, m22;
};

/// A vector of deformation gradients F with the terms of their nearest rotations R:
/// zeta R = F ((s^2 + |F|^2) I - 2 F^T F) + 2 s cof(F).
template <class V>
struct Deformation {
  Mat3<V> F, cofactors;
  Symmetric3<V> squared;  ///< F^T F
  V squared_norm;         ///< |F|^2
  V det8;                 ///< 8 det F
  V cofactor_term;        ///< 4 |cof F|^2
  V trace;                ///< s = tr(R^T F), from findTraces()
  V slope, step;          ///< of its last iteration
};

/// 1 / v. In single precision only accurate to a few thousandths, but much faster than a division.
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_INLINE V roughReciprocal(D d, V v) {
  if constexpr (sizeof(T) == 4)
    return hn::ApproximateReciprocal(v);
  else
    return hn::Div(hn::Set(d, T{1}), v);
}

/// 1 / v within rounding.
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_INLINE V reciprocal(D d, V v) {
  const V rough = roughReciprocal(d, v);
  if constexpr (sizeof(T) == 4)
    return hn::Mul(rough, hn::NegMulAdd(v, rough, hn::Set(d, T{2})));
  else
    return rough;
}

/// sqrt(v), as accurate as roughReciprocal().
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_INLINE V roughSqrt(D, V v) {
  if constexpr (sizeof(T) == 4)
    return hn::Mul(v, hn::ApproximateReciprocalSqrt(v));
  else
    return hn::Sqrt(v);
}

template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_INLINE Deformation<V> deformation(D d, const Mat3<V>& F) {
  const Mat3<V> C{cross(F.c1, F.c2), cross(F.c2, F.c0), cross(F.c0, F.c1)};
  Deformation<V> result;
  result.F = F;
  result.cofactors = C;
  result.squared = {dot(F.c0, F.c0), dot(F.c0, F.c1), dot(F.c0, F.c2),
                    dot(F.c1, F.c1), dot(F.c1, F.c2), dot(F.c2, F.c2)};
  result.squared_norm = hn::Add(hn::Add(result.squared.m00, result.squared.m11), result.squared.m22);
  result.det8 = hn::Mul(hn::Set(d, T{8}), dot(F.c0, C.c0));
  result.cofactor_term =
      hn::Mul(hn::Set(d, T{4}), hn::Add(hn::Add(dot(C.c0, C.c0), dot(C.c1, C.c1)), dot(C.c2, C.c2)));
  return result;
}

/// Whether an iteration of findTraces() has converged: a step of relative size r leaves an error of about 2
/// r^2 near rest. False for NaN.
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_INLINE hn::Mask<D> converged(D d, const Deformation<V>& a) {
  return hn::Lt(hn::Abs(a.step), hn::Mul(hn::Set(d, sizeof(T) == 4 ? T(3e-4) : T(2e-8)), a.trace));
}

/// The largest root of the quartic in extractRotation(). Each operation waits for the previous one. Several
/// vectors are processed at once to use the waiting time.
template <std::size_t kVectors, class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_INLINE void findTraces(D d, Deformation<V>* all) {
  const V three = hn::Set(d, T{3}), four = hn::Set(d, T{4});
  for (std::size_t k = 0; k < kVectors; ++k) all[k].trace = roughSqrt(d, hn::Mul(three, all[k].squared_norm));
  constexpr int kMaxIterations = 8;  // a bound; what has not converged is solved one by one
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    for (std::size_t k = 0; k < kVectors; ++k) {
      Deformation<V>& a = all[k];
      const V gap = hn::MulSub(a.trace, a.trace, a.squared_norm);
      a.slope = hn::MulSub(hn::Mul(four, a.trace), gap, a.det8);
      const V value = hn::MulSub(gap, gap, hn::MulAdd(a.det8, a.trace, a.cofactor_term));
      a.step = hn::Mul(value, roughReciprocal(d, a.slope));
      a.trace = hn::Sub(a.trace, a.step);
    }
    auto all_converged = converged(d, all[0]);
    for (std::size_t k = 1; k < kVectors; ++k) all_converged = hn::And(all_converged, converged(d, all[k]));
    if (hn::AllTrue(d, all_converged)) break;
  }
}

/// F - R
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_INLINE Mat3<V> strainOf(D d, const Deformation<V>& deformation) {
  const Mat3<V>&F = deformation.F, &C = deformation.cofactors;
  const Symmetric3<V>& S = deformation.squared;
  const V s = deformation.trace, squared_trace = hn::Mul(s, s);
  const V zeta = hn::NegMulAdd(hn::Set(d, T(0.25)), deformation.det8,
                               hn::Mul(hn::Sub(squared_trace, deformation.squared_norm), s));
  const V scale = reciprocal(d, zeta), twice = hn::Add(scale, scale);
  const V diagonal = hn::NegMulAdd(scale, hn::Add(squared_trace, deformation.squared_norm), hn::Set(d, T{1}));
  const V m01 = hn::Mul(twice, S.m01), m02 = hn::Mul(twice, S.m02), m12 = hn::Mul(twice, S.m12);
  const V cofactor = hn::Mul(twice, s);
  const auto column = [&](V k0, V k1, V k2, const Vec3<V>& c) {
    const Vec3<V> v = combine(F, k0, k1, k2);
    return Vec3<V>{hn::NegMulAdd(cofactor, c.x, v.x), hn::NegMulAdd(cofactor, c.y, v.y),
                   hn::NegMulAdd(cofactor, c.z, v.z)};
  };
  return {column(hn::MulAdd(twice, S.m00, diagonal), m01, m02, C.c0),
          column(m01, hn::MulAdd(twice, S.m11, diagonal), m12, C.c1),
          column(m02, m12, hn::MulAdd(twice, S.m22, diagonal), C.c2)};
}

/// a A + b B
template <class V>
HWY_INLINE Mat3<V> blend(V a, const Mat3<V>& A, V b, const Mat3<V>& B) {
  const auto column = [&](const Vec3<V>& u, const Vec3<V>& v) {
    return Vec3<V>{hn::MulAdd(a, u.x, hn::Mul(b, v.x)), hn::MulAdd(a, u.y, hn::Mul(b, v.y)),
                   hn::MulAdd(a, u.z, hn::Mul(b, v.z))};
  };
  return {column(A.c0, B.c0), column(A.c1, B.c1), column(A.c2, B.c2)};
}

/// Energy [J] and stress times volume of a vector of tets.
template <class V>
struct Response {
  V energy;
  Mat3<V> stress;
};

/// Recomputes, lane by lane, the tets whose rotation is not or hardly unique.
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_NOINLINE void respondOneByOne(D d, hn::Mask<D> wanted, V shear, V bulk, const Mat3<V>& F,
                                  Response<V>* response) {
  constexpr std::size_t kMost = 16;
  HWY_ALIGN T f[9][kMost], stress[9][kMost], energy[kMost], shears[kMost], bulks[kMost];
  const V* columns = &F.c0.x;
  V* result = &response->stress.c0.x;
  for (int k = 0; k < 9; ++k) {
    hn::Store(columns[k], d, f[k]);
    hn::Store(result[k], d, stress[k]);
  }
  hn::Store(response->energy, d, energy);
  hn::Store(hn::IfThenElse(wanted, shear, hn::Set(d, T{-1})), d, shears);
  hn::Store(bulk, d, bulks);
  for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane) {
    if (shears[lane] < T{0}) continue;
    Eigen::Matrix3d one, gradient;
    for (int k = 0; k < 9; ++k) one(k) = static_cast<double>(f[k][lane]);
    const Lame lame{0.5 * static_cast<double>(shears[lane]), static_cast<double>(bulks[lane])};
    energy[lane] = static_cast<T>(corotatedEnergy(one, lame, &gradient));
    for (int k = 0; k < 9; ++k) stress[k][lane] = static_cast<T>(gradient(k));
  }
  for (int k = 0; k < 9; ++k) result[k] = hn::Load(d, stress[k]);
  response->energy = hn::Load(d, energy);
}

/// @param shear 2 mu, @param bulk lambda, both times volume [J].
template <class D, class V = hn::Vec<D>, typename T = hn::TFromD<D>>
HWY_INLINE Response<V> respond(D d, V shear, V bulk, const Deformation<V>& deformation) {
  const V dilation = hn::Sub(deformation.trace, hn::Set(d, T{3}));
  const V pressure = hn::Mul(bulk, dilation);
  const Mat3<V> strain = strainOf(d, deformation);
  const V squared =
      hn::Add(hn::Add(dot(strain.c0, strain.c0), dot(strain.c1, strain.c1)), dot(strain.c2, strain.c2));
  Response<V> response;
  response.energy = hn::Mul(hn::Set(d, T(0.5)), hn::MulAdd(shear, squared, hn::Mul(pressure, dilation)));
  // shear (F - R) + pressure R
  response.stress = blend(hn::Sub(shear, pressure), strain, pressure, deformation.F);
  // The limit of extractRotation().
  const V least_slope = hn::Mul(hn::Set(d, T(1e-2)), hn::Mul(deformation.squared_norm, deformation.trace));
  const auto unique = hn::And(hn::Gt(deformation.slope, least_slope), converged(d, deformation));
  if (HWY_UNLIKELY(!hn::AllTrue(d, unique))) {
    respondOneByOne(d, hn::Not(unique), shear, bulk, deformation.F, &response);
  }
  return response;
}

}  // namespace softbody::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
