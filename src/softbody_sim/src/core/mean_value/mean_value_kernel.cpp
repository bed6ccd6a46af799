#include "mean_value/mean_value_kernel.h"

#include <hwy/aligned_allocator.h>

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "mean_value/mean_value_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace softbody::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Lanes = hn::ScalableTag<double>;
using Vector = hn::Vec<Lanes>;
constexpr Lanes kLanes;
constexpr double kHalfPi = 1.57079632679489661923;
constexpr double kOnVertex = 1e-10;      ///< distance [size]
constexpr double kNearPlane = 1e-4;      ///< determinant below which a face may contain the point
constexpr double kOnPlane = 1e-12;       ///< determinant that is only rounding
constexpr double kMissingAngle = 4e-12;  ///< the angles around a point on a face sum to 2 pi

/// Even and odd powers separately: the chain of dependent operations is half as long as in Horner's scheme.
/// Highest power first.
template <std::size_t kCount>
Vector polynomial(const double (&coefficients)[kCount], Vector z) {
  static_assert(kCount % 2 == 1);
  const Vector squared = hn::Mul(z, z);
  Vector even = hn::Set(kLanes, coefficients[0]), odd = hn::Set(kLanes, coefficients[1]);
#pragma GCC unroll 16
  for (std::size_t k = 2; k + 1 < kCount; k += 2) {
    even = hn::MulAdd(even, squared, hn::Set(kLanes, coefficients[k]));
    odd = hn::MulAdd(odd, squared, hn::Set(kLanes, coefficients[k + 1]));
  }
  even = hn::MulAdd(even, squared, hn::Set(kLanes, coefficients[kCount - 1]));
  return hn::MulAdd(odd, z, even);
}

/// atan(y) / y of z = y^2 in [0, 1], to 3e-16: interpolations at Chebyshev nodes of [0, 0.1] and of [0, 1].
Vector arctangentRatio(Vector z) {
  constexpr double kOfSmall[] = {0.039874602408999545, -0.0633812574377399,  0.07660342260925512,
                                 -0.0908906660255604,  0.11111048202894935,  -0.14285713073165482,
                                 0.19999999988253012,  -0.33333333333289406, 0.9999999999999998};
  constexpr double kOfAll[] = {
      2.969635660165779e-05, -0.00031420077366807334, 0.0015739493241755762, -0.0050003664537326496,
      0.011430023675054508,  -0.02033087003302746,    0.02992405293802711,   -0.03852606834610674,
      0.045668724719449945,  -0.052025829246698206,   0.05867776001706719,   -0.06664007607654046,
      0.07691950418796795,   -0.09090875100099982,    0.11111108947215684,   -0.14285714201153485,
      0.19999999998244405,   -0.333333333333188,      0.9999999999999998};
  const bool small = hn::AllTrue(kLanes, hn::Le(z, hn::Set(kLanes, 0.1)));
  return small ? polynomial(kOfSmall, z) : polynomial(kOfAll, z);
}

/// Half the angle between two unit vectors over the angle's sine.
/// tan(angle / 2) = sine / (1 + cosine); for an obtuse angle the supplement is used, so that the tangent is
/// at most 1.
Vector halfAngleOverSine(Vector squared_sine, Vector cosine) {
  const Vector q = hn::Div(hn::Set(kLanes, 1.0), hn::Add(hn::Set(kLanes, 1.0), hn::Abs(cosine)));
  const Vector acute = hn::Mul(q, arctangentRatio(hn::Mul(squared_sine, hn::Mul(q, q))));
  const auto is_obtuse = hn::Lt(cosine, hn::Zero(kLanes));
  if (hn::AllFalse(kLanes, is_obtuse)) return acute;
  const Vector sine = hn::Sqrt(hn::Max(squared_sine, hn::Set(kLanes, 1e-300)));
  const Vector obtuse = hn::Sub(hn::Div(hn::Set(kLanes, kHalfPi), sine), acute);
  return hn::IfThenElse(is_obtuse, obtuse, acute);
}

/// Winding of a product of complex numbers around 0, without an arctangent: it changes when the imaginary
/// part changes its sign. Undefined if a factor is 0, for a point on an edge.
class TurnCounter {
 public:
  // Explicit: the compiler would generate the default constructor for the baseline target.
  TurnCounter() : real_(hn::Set(kLanes, 1.0)), imaginary_(hn::Zero(kLanes)), turns_(hn::Zero(Integers())) {}

  void multiply(Vector real, Vector imaginary) {
    const Vector next_real = hn::NegMulAdd(imaginary_, imaginary, hn::Mul(real_, real));
    const Vector next = hn::MulAdd(imaginary_, real, hn::Mul(real_, imaginary));
    // Only the sign bits of these are used.
    const Vector up = hn::AndNot(hn::Or(imaginary_, imaginary), next);
    const Vector down = hn::AndNot(next, hn::And(imaginary_, imaginary));
    turns_ = hn::Sub(hn::Add(turns_, signBit(up)), signBit(down));
    real_ = next_real;
    imaginary_ = next;
    if (++factors_ % 8 == 0) normalize();
  }
  Vector turns() const { return hn::ConvertTo(kLanes, turns_); }

 private:
  using Integers = hn::RebindToSigned<Lanes>;

  static hn::Vec<Integers> signBit(Vector value) {
    const hn::RebindToUnsigned<Lanes> bits;
    return hn::BitCast(Integers(), hn::ShiftRight<63>(hn::BitCast(bits, value)));
  }

  void normalize() {
    const Vector scale = hn::Div(hn::Set(kLanes, 1.0), hn::Max(hn::Abs(real_), hn::Abs(imaginary_)));
    real_ = hn::Mul(real_, scale);
    imaginary_ = hn::Mul(imaginary_, scale);
  }

  Vector real_, imaginary_;
  hn::Vec<Integers> turns_;
  int factors_ = 0;
};

/// One vector of points against the whole cage.
class Batch {
 public:
  explicit Batch(const CageMesh& cage)
      : cage_(cage),
        vertices_(hwy::AllocateAligned<double>(static_cast<std::size_t>(cage.vertices.rows()) * 4 * n_)),
        edges_(hwy::AllocateAligned<double>(cage.edges.size() * 5 * n_)),
        weights_(hwy::AllocateAligned<double>(static_cast<std::size_t>(cage.vertices.rows()) * n_)),
        turns_(hn::Zero(kLanes)),
        on_vertex_(turns_),
        on_face_(turns_) {}

  void compute(Vector x, Vector y, Vector z) {
    on_vertex_ = on_face_ = hn::Set(kLanes, -1.0);
    measureVertices(x, y, z);
    measureEdges();
    std::fill_n(weights_.get(), cage_.vertices.rows() * static_cast<Eigen::Index>(n_), 0.0);
    TurnCounter half_solid_angle;
    for (std::size_t f = 0; f < cage_.faces.size(); ++f) addFace(static_cast<int>(f), &half_solid_angle);
    turns_ = half_solid_angle.turns();
  }

  void store(int count, double* weights, int* turns, CageContact* contacts) {
    HWY_ALIGN double lanes[3][HWY_MAX_BYTES / sizeof(double)];
    hn::Store(turns_, kLanes, lanes[0]);
    hn::Store(on_vertex_, kLanes, lanes[1]);
    hn::Store(on_face_, kLanes, lanes[2]);
    for (int p = 0; p < count; ++p) {
      turns[p] = static_cast<int>(lanes[0][p]);
      contacts[p] = {static_cast<int>(lanes[1][p]), static_cast<int>(lanes[2][p])};
    }
    normalizeWeights();
    const Eigen::Index columns = cage_.vertices.rows();
    for (Eigen::Index v = 0; v < columns; ++v) {
      for (int p = 0; p < count; ++p) weights[p * columns + v] = weights_[v * n_ + p];
    }
  }

 private:
  /// Unit directions to the vertices and one over the distances.
  void measureVertices(Vector x, Vector y, Vector z) {
    const Vector squared_contact = hn::Set(kLanes, kOnVertex * cage_.size * kOnVertex * cage_.size);
    for (Eigen::Index v = 0; v < cage_.vertices.rows(); ++v) {
      const Vector dx = hn::Sub(hn::Set(kLanes, cage_.vertices(v, 0)), x);
      const Vector dy = hn::Sub(hn::Set(kLanes, cage_.vertices(v, 1)), y);
      const Vector dz = hn::Sub(hn::Set(kLanes, cage_.vertices(v, 2)), z);
      const Vector squared = hn::MulAdd(dx, dx, hn::MulAdd(dy, dy, hn::Mul(dz, dz)));
      const auto touches = hn::Le(squared, squared_contact);
      on_vertex_ = hn::IfThenElse(touches, hn::Set(kLanes, static_cast<double>(v)), on_vertex_);
      const Vector inverse = hn::Div(hn::Set(kLanes, 1.0), hn::Sqrt(squared));
      double* out = &vertices_[static_cast<std::size_t>(v) * 4 * n_];
      hn::Store(hn::Mul(dx, inverse), kLanes, out);
      hn::Store(hn::Mul(dy, inverse), kLanes, out + n_);
      hn::Store(hn::Mul(dz, inverse), kLanes, out + 2 * n_);
      hn::Store(inverse, kLanes, out + 3 * n_);
    }
  }

  /// u_from x u_to of the unit directions, half the angle between them over its sine, and its cosine.
  void measureEdges() {
    double* out = edges_.get();
    for (const CageMesh::Edge& edge : cage_.edges) {
      const double *a = vertex(edge.from), *b = vertex(edge.to);
      const Vector ax = load(a, 0), ay = load(a, 1), az = load(a, 2);
      const Vector bx = load(b, 0), by = load(b, 1), bz = load(b, 2);
      const Vector x = hn::NegMulAdd(az, by, hn::Mul(ay, bz));
      const Vector y = hn::NegMulAdd(ax, bz, hn::Mul(az, bx));
      const Vector z = hn::NegMulAdd(ay, bx, hn::Mul(ax, by));
      const Vector cosine = hn::MulAdd(ax, bx, hn::MulAdd(ay, by, hn::Mul(az, bz)));
      hn::Store(x, kLanes, out);
      hn::Store(y, kLanes, out + n_);
      hn::Store(z, kLanes, out + 2 * n_);
      hn::Store(halfAngleOverSine(squaredNorm(x, y, z), cosine), kLanes, out + 3 * n_);
      hn::Store(cosine, kLanes, out + 4 * n_);
      out += 5 * n_;
    }
  }

  void addFace(int f, TurnCounter* half_solid_angle) {
    const CageMesh::Face& face = cage_.faces[static_cast<std::size_t>(f)];
    const double* edges[3] = {edge(face.edges[0]), edge(face.edges[1]), edge(face.edges[2])};
    const double* last = vertex(face.corners[2]);
    // Six times the volume that the three unit directions span.
    const Vector determinant = hn::Mul(hn::Set(kLanes, face.signs[0]),
                                       dotCross(edges[0], load(last, 0), load(last, 1), load(last, 2)));
    // tan(solid angle / 2) of a triangle (van Oosterom and Strackee 1983).
    const Vector cosines = hn::Add(load(edges[0], 4), hn::Add(load(edges[1], 4), load(edges[2], 4)));
    half_solid_angle->multiply(hn::Add(hn::Set(kLanes, 1.0), cosines), determinant);
    const Vector size = hn::Abs(determinant);
    if (!hn::AllFalse(kLanes, hn::Le(size, hn::Set(kLanes, kNearPlane)))) noteContact(f, edges, size);
    const Vector inverse = hn::IfThenElseZero(hn::Gt(size, hn::Set(kLanes, kOnPlane)),
                                              hn::Div(hn::Set(kLanes, 1.0), determinant));
    addWeights(face, edges, inverse);
  }

  /// The mean vector of the triangle, m = sum theta/2 n over its edges, equals sum w_k (p_k - x): solve for
  /// w_k.
  void addWeights(const CageMesh::Face& face, const double* const (&edges)[3], Vector inverse_determinant) {
    Vector x = hn::Zero(kLanes), y = x, z = x, sign[3];
    for (int k = 0; k < 3; ++k) {
      sign[k] = hn::Set(kLanes, face.signs[k]);
      const Vector length = hn::Mul(sign[k], load(edges[k], 3));
      x = hn::MulAdd(length, load(edges[k], 0), x);
      y = hn::MulAdd(length, load(edges[k], 1), y);
      z = hn::MulAdd(length, load(edges[k], 2), z);
    }
    for (int k = 0; k < 3; ++k) {
      const int opposite = (k + 1) % 3;
      const Vector part = hn::Mul(sign[opposite], dotCross(edges[opposite], x, y, z));
      const Vector scale = hn::Mul(load(vertex(face.corners[k]), 3), inverse_determinant);
      double* weight = &weights_[static_cast<std::size_t>(face.corners[k]) * n_];
      hn::Store(hn::MulAdd(part, scale, hn::Load(kLanes, weight)), kLanes, weight);
    }
  }

  /// The angles at a point on the face sum to 2 pi; the deficit grows with the squared distance.
  void noteContact(int f, const double* const (&edges)[3], Vector determinant) {
    Vector missing = hn::Set(kLanes, 2.0 * kHalfPi);
    for (const double* e : edges) {
      const Vector squared = squaredNorm(load(e, 0), load(e, 1), load(e, 2));
      missing = hn::NegMulAdd(load(e, 3), hn::Sqrt(hn::Max(squared, hn::Set(kLanes, 1e-300))), missing);
    }
    const auto touches = hn::And(hn::Le(determinant, hn::Set(kLanes, kNearPlane)),
                                 hn::Lt(missing, hn::Set(kLanes, kMissingAngle)));
    on_face_ = hn::IfThenElse(touches, hn::Set(kLanes, static_cast<double>(f)), on_face_);
  }

  void normalizeWeights() {
    const std::size_t size = static_cast<std::size_t>(cage_.vertices.rows()) * n_;
    Vector sum = hn::Zero(kLanes);
    for (std::size_t i = 0; i < size; i += n_) sum = hn::Add(sum, hn::Load(kLanes, &weights_[i]));
    const Vector scale = hn::Div(hn::Set(kLanes, 1.0), sum);
    for (std::size_t i = 0; i < size; i += n_) {
      hn::Store(hn::Mul(hn::Load(kLanes, &weights_[i]), scale), kLanes, &weights_[i]);
    }
  }

  static Vector squaredNorm(Vector x, Vector y, Vector z) {
    return hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(z, z)));
  }
  static Vector dotCross(const double* e, Vector x, Vector y, Vector z) {
    return hn::MulAdd(load(e, 0), x, hn::MulAdd(load(e, 1), y, hn::Mul(load(e, 2), z)));
  }
  static Vector load(const double* row, std::size_t k) {
    return hn::Load(kLanes, row + k * hn::Lanes(kLanes));
  }
  const double* vertex(int v) const { return &vertices_[static_cast<std::size_t>(v) * 4 * n_]; }
  const double* edge(int e) const { return &edges_[static_cast<std::size_t>(e) * 5 * n_]; }

  const std::size_t n_ = hn::Lanes(kLanes);
  const CageMesh& cage_;
  hwy::AlignedFreeUniquePtr<double[]> vertices_, edges_, weights_;
  Vector turns_, on_vertex_, on_face_;
};

}  // namespace

void meanValueKernel(const CageMesh& cage, const double* points, int count, double* weights, int* turns,
                     CageContact* contacts) {
  const int lanes = static_cast<int>(hn::Lanes(kLanes));
  Batch batch(cage);
  HWY_ALIGN double coordinates[3][HWY_MAX_BYTES / sizeof(double)];
  for (int first = 0; first < count; first += lanes) {
    for (int p = 0; p < lanes; ++p) {
      const std::ptrdiff_t place = std::min(first + p, count - 1);
      const double* point = points + 3 * place;
      for (int k = 0; k < 3; ++k) coordinates[k][p] = point[k];
    }
    batch.compute(hn::Load(kLanes, coordinates[0]), hn::Load(kLanes, coordinates[1]),
                  hn::Load(kLanes, coordinates[2]));
    batch.store(std::min(lanes, count - first), weights + first * cage.vertices.rows(), turns + first,
                contacts + first);
  }
}

}  // namespace softbody::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace softbody {
HWY_EXPORT(meanValueKernel);

void meanValueKernel(const CageMesh& cage, const double* points, int count, double* weights, int* turns,
                     CageContact* contacts) {
  HWY_DYNAMIC_DISPATCH(meanValueKernel)(cage, points, count, weights, turns, contacts);
}
}  // namespace softbody
#endif
