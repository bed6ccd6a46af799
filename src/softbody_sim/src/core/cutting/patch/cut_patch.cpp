#include "cutting/patch/cut_patch.h"

#include <fmt/format.h>

#include <stdexcept>

namespace softbody {
namespace {

Eigen::Vector3d normalOf(const Points& p, int a, int b, int c) {
  const Eigen::Vector3d first = p.row(b) - p.row(a), second = p.row(c) - p.row(a);
  return first.cross(second);
}

/// Whether the diagonal 0-2 of a quadrilateral folds it less than 1-3.
bool splitAlongFirstDiagonal(const Points& p, const Eigen::Vector4i& q) {
  const double first =
      normalOf(p, q[0], q[1], q[2]).normalized().dot(normalOf(p, q[0], q[2], q[3]).normalized());
  const double second =
      normalOf(p, q[0], q[1], q[3]).normalized().dot(normalOf(p, q[1], q[2], q[3]).normalized());
  return first >= second;
}

}  // namespace

CutPatch ruledPatch(const Points& before, const Points& now) {
  const int count = static_cast<int>(before.rows());
  if (count < 2 || now.rows() != before.rows()) {
    throw std::invalid_argument(fmt::format(
        "a ruled patch needs two edges with the same number of points, at least 2; they have {} and {}",
        count, now.rows()));
  }
  CutPatch patch;
  patch.vertices.resize(before.rows() + now.rows(), 3);
  patch.vertices << before, now;
  patch.triangles.resize(2 * (before.rows() - 1), 3);
  for (int k = 0; k + 1 < count; ++k) {
    const Eigen::Vector4i q(k, k + 1, count + k + 1, count + k);
    auto halves = patch.triangles.middleRows<2>(2 * static_cast<Eigen::Index>(k));
    if (splitAlongFirstDiagonal(patch.vertices, q)) {
      halves << q[0], q[1], q[2], q[0], q[2], q[3];
    } else {
      halves << q[0], q[1], q[3], q[1], q[2], q[3];
    }
  }
  return patch;
}

CutPatch joined(const CutPatch& first, const CutPatch& second) {
  CutPatch both;
  both.vertices.resize(first.vertices.rows() + second.vertices.rows(), 3);
  both.vertices << first.vertices, second.vertices;
  both.triangles.resize(first.triangles.rows() + second.triangles.rows(), 3);
  both.triangles << first.triangles, second.triangles.array() + static_cast<int>(first.vertices.rows());
  return both;
}

CutPatch inGeneralPosition(CutPatch patch) {
  patch.vertices.rowwise() += Eigen::RowVector3d(1.2173e-8, -0.7919e-8, 1.3711e-8);
  return patch;
}

// Rounded in memory: GCC 12 drops the conversion of a pair of numbers that stays in a register (-O2, double
// to float to double).
Points inSinglePrecision(const Points& points) {
  const Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> single = points.cast<float>();
  return single.cast<double>();
}

// Volatile, because g++ 12 drops the conversion of neighbouring coordinates at -O3.
Eigen::Vector3d rounded(const Eigen::Vector3d& point) {
  return point.unaryExpr([](double coordinate) {
    const volatile auto single = static_cast<float>(coordinate);
    return static_cast<double>(single);
  });
}

}  // namespace softbody
