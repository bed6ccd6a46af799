#include "cutting/remesh/edit_accuracy.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace softbody {
namespace {

constexpr double kFlat = 0.02;        // sine of the least angle below which a triangle has no reliable normal
constexpr double kLeastCosine = 0.5;  // between the normals of a triangle before and after
constexpr double kLeastStarCosine = 0.2;  // between a new normal and the mean normal before

double distanceToSegment(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d along = b - a;
  const double length = along.squaredNorm();
  const double share = length > 0.0 ? std::clamp(along.dot(p - a) / length, 0.0, 1.0) : 0.0;
  return (a + share * along - p).norm();
}

double distanceToTriangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                          const Eigen::Vector3d& c) {
  const Eigen::Vector3d normal = (b - a).cross(c - a);
  if (normal.dot((b - a).cross(p - a)) >= 0.0 && normal.dot((c - b).cross(p - b)) >= 0.0 &&
      normal.dot((a - c).cross(p - c)) >= 0.0 && normal.squaredNorm() > 0.0) {
    return std::abs(normal.normalized().dot(p - a));
  }
  return std::min({distanceToSegment(p, a, b), distanceToSegment(p, b, c), distanceToSegment(p, c, a)});
}

/// Distance between the lines of the two diagonals of a quadrilateral [m]: how far a flip moves the surface.
double distanceOfDiagonals(const CutComplex& complex, const std::array<int, 4>& corners) {
  const auto& [a, b, c, d] = corners;
  const Eigen::Vector3d across = (complex.at(b) - complex.at(a)).cross(complex.at(d) - complex.at(c));
  return across.squaredNorm() > 0.0 ? std::abs(across.normalized().dot(complex.at(c) - complex.at(a))) : 0.0;
}

/// Where the first diagonal of a quadrilateral is nearest to the second one.
Eigen::Vector3d crossingOfDiagonals(const CutComplex& complex, const std::array<int, 4>& corners) {
  const auto& [a, b, c, d] = corners;
  const Eigen::Vector3d first = complex.at(b) - complex.at(a), second = complex.at(d) - complex.at(c);
  const Eigen::Vector3d normal = first.cross(second), plane = second.cross(normal);
  const double slope = first.dot(plane);
  const double share = slope != 0.0 ? (complex.at(c) - complex.at(a)).dot(plane) / slope : 0.5;
  return complex.at(a) + std::clamp(share, 0.0, 1.0) * first;
}

Eigen::Vector3d normalOf(const PlacesAfter& at, const std::array<int, 3>& corners) {
  return (at(corners[1]) - at(corners[0])).cross(at(corners[2]) - at(corners[0]));
}

bool keepsNormals(const CutComplex& complex, const ComplexEdit& edit) {
  const PlacesAfter at(complex, edit);
  std::array<Eigen::Vector3d, 2> sums{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  for (const int t : edit.removed) {
    sums[static_cast<std::size_t>(complex.triangles[t].sheet)] += complex.normalOf(complex.triangles[t]);
  }
  return std::all_of(edit.added.begin(), edit.added.end(), [&](const ComplexEdit::Added& added) {
    const ComplexTriangle& parent = complex.triangles[added.parent];
    const Eigen::Vector3d& sum = sums[static_cast<std::size_t>(parent.sheet)];
    const Eigen::Vector3d normal = normalOf(at, added.corners);
    if (normal.dot(sum) <= kLeastStarCosine * normal.norm() * sum.norm()) return false;
    if (parent.shape < kFlat) return true;
    const Eigen::Vector3d before = complex.normalOf(parent);
    return normal.dot(before) > kLeastCosine * normal.norm() * before.norm();
  });
}

/// The new triangle of a sheet that is nearest to a point; -1: there is none on this sheet.
int nearestAdded(const CutComplex& complex, const ComplexEdit& edit, Sheet sheet,
                 const Eigen::Vector3d& point, double enough, double* distance) {
  const PlacesAfter at(complex, edit);
  int nearest = -1;
  *distance = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < edit.added.size() && *distance > enough; ++k) {
    if (complex.triangles[edit.added[k].parent].sheet != sheet) continue;
    const auto& [a, b, c] = edit.added[k].corners;
    const double own = distanceToTriangle(point, at(a), at(b), at(c));
    if (own < *distance) *distance = own, nearest = static_cast<int>(k);
  }
  return nearest;
}

/// Calls visit(sheet, point) for the middles of the edges at the vertex that an edit removes: a sharp edge
/// can be far from the new triangles between its ends.
template <class Visit>
void forEachMiddle(const CutComplex& complex, const ComplexEdit& edit, const Visit& visit) {
  for (const int t : edit.removed) {
    const ComplexTriangle& triangle = complex.triangles[t];
    const int k = triangle.cornerOf(edit.gone);
    if (k < 0) continue;
    visit(triangle.sheet, 0.5 * (complex.at(edit.gone) + complex.at(triangle.corners[(k + 1) % 3])));
  }
}

/// Calls visit(sheet, point) for the places that must stay near to the new triangles.
template <class Visit>
void forEachSample(const CutComplex& complex, const ComplexEdit& edit, const Visit& visit) {
  for (const int t : edit.removed) {
    for (const Eigen::Vector3d& sample : complex.triangles[t].samples)
      visit(complex.triangles[t].sheet, sample);
  }
  if (edit.gone >= 0 && !complex.vertices[edit.gone].is_new) {
    for (const Sheet sheet : kSheets) {
      if (complex.hasSheet(edit.gone, sheet)) visit(sheet, complex.at(edit.gone));
    }
    forEachMiddle(complex, edit, visit);
  }
  if (edit.flipped && distanceOfDiagonals(complex, *edit.flipped) > 0.0) {
    visit(complex.triangles[edit.removed.front()].sheet, crossingOfDiagonals(complex, *edit.flipped));
  }
}

/// The new edge of a line that is nearest to a point.
std::size_t nearestLine(const CutComplex& complex, const ComplexEdit& edit, const Eigen::Vector3d& point,
                        double* distance) {
  const PlacesAfter at(complex, edit);
  std::size_t nearest = 0;
  *distance = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < edit.new_lines.size(); ++k) {
    const double own = distanceToSegment(point, at(edit.new_lines[k][0]), at(edit.new_lines[k][1]));
    if (own < *distance) *distance = own, nearest = k;
  }
  return nearest;
}

std::array<int, 2> keyOf(const std::array<int, 2>& edge) {
  return {std::min(edge[0], edge[1]), std::max(edge[0], edge[1])};
}

/// Calls visit(point) for the places that must stay near to the new edges of a line.
template <class Visit>
void forEachLineSample(const CutComplex& complex, const ComplexEdit& edit, const Visit& visit) {
  if (edit.old_lines.empty()) return;
  for (const std::array<int, 2>& edge : edit.old_lines) {
    const auto found = complex.line_samples.find(keyOf(edge));
    if (found == complex.line_samples.end()) continue;
    for (const Eigen::Vector3d& sample : found->second) visit(sample);
  }
  if (edit.old_lines.size() == 2 && !complex.vertices[edit.gone].is_new) visit(complex.at(edit.gone));
}

}  // namespace

bool staysNear(const CutComplex& complex, const ComplexEdit& edit, double distance) {
  if (!keepsNormals(complex, edit)) return false;
  bool near = true;
  double away = 0.0;
  forEachLineSample(complex, edit, [&](const Eigen::Vector3d& sample) {
    nearestLine(complex, edit, sample, &away);
    near = near && away <= distance;
  });
  forEachSample(complex, edit, [&](Sheet sheet, const Eigen::Vector3d& sample) {
    near = near && nearestAdded(complex, edit, sheet, sample, distance, &away) >= 0 && away <= distance;
  });
  return near;
}

void passOnSamples(const ComplexEdit& edit, CutComplex* complex, std::vector<ComplexTriangle>* made) {
  double away = 0.0;
  forEachSample(*complex, edit, [&](Sheet sheet, const Eigen::Vector3d& sample) {
    const int nearest = nearestAdded(*complex, edit, sheet, sample, 0.0, &away);
    if (nearest >= 0) (*made)[static_cast<std::size_t>(nearest)].samples.push_back(sample);
  });
  std::vector<std::pair<std::array<int, 2>, Eigen::Vector3d>> of_lines;
  forEachLineSample(*complex, edit, [&](const Eigen::Vector3d& sample) {
    of_lines.emplace_back(keyOf(edit.new_lines[nearestLine(*complex, edit, sample, &away)]), sample);
  });
  for (const std::array<int, 2>& edge : edit.old_lines) complex->line_samples.erase(keyOf(edge));
  for (const auto& [edge, sample] : of_lines) complex->line_samples[edge].push_back(sample);
}

}  // namespace softbody
