#include "cutting/remesh/complex_edits.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "cutting/patch/cut_patch.h"
#include "cutting/remesh/edit_accuracy.h"

namespace softbody {
namespace {

void clear(ComplexEdit* edit) {
  edit->removed.clear();
  edit->added.clear();
  edit->carriers.clear();
  edit->old_lines.clear();
  edit->new_lines.clear();
  edit->flipped.reset();
  edit->split.reset();
  edit->gone = edit->target = -1;
}

/// Whether the fill and the skin have different vertices at an edge of the fill on the curve.
bool isSeparate(const ComplexTriangle& triangle, int k) {
  return triangle.sheet == Sheet::kFill && triangle.curve[k] >= 0;
}

/// Describes the split of an edge, in both sheets if it is on the curve.
void splitAt(const CutComplex& complex, int t, int k, double share, ComplexEdit* edit) {
  const ComplexTriangle& triangle = complex.triangles[t];
  const int a = triangle.corners[k], b = triangle.corners[(k + 1) % 3];
  edit->target = static_cast<int>(complex.vertices.size());
  edit->position = rounded(complex.at(a) + share * (complex.at(b) - complex.at(a)));
  edit->split = {a, b};
  if (triangle.onLine(k)) {
    edit->old_lines = {{a, b}};
    edit->new_lines = {{a, edit->target}, {edit->target, b}};
  }
  const bool in_both = triangle.lines[k] == Line::kCurve;
  for (const Sheet sheet : kSheets) {
    if (sheet != triangle.sheet && !in_both) continue;
    for (const int other : complex.trianglesAt(a, b, sheet)) {
      const ComplexTriangle& parent = complex.triangles[other];
      edit->removed.push_back(other);
      edit->carriers.push_back({other, (1.0 - share) * Eigen::Vector3d::Unit(parent.cornerOf(a)) +
                                           share * Eigen::Vector3d::Unit(parent.cornerOf(b))});
      for (const int end : {a, b}) {
        std::array<int, 3> corners = parent.corners;
        corners[parent.cornerOf(end)] = edit->target;
        edit->added.push_back({corners, other});
      }
    }
  }
}

/// Removes a vertex's triangles and adds them again with the target in its place, without those that contain
/// the neighbour.
void replaceVertex(const CutComplex& complex, int vertex, int neighbour, ComplexEdit* edit) {
  edit->gone = vertex;
  edit->removed = complex.vertices[vertex].triangles;
  for (const int t : edit->removed) {
    const ComplexTriangle& triangle = complex.triangles[t];
    if (neighbour >= 0 && triangle.cornerOf(neighbour) >= 0) continue;
    std::array<int, 3> corners = triangle.corners;
    corners[triangle.cornerOf(vertex)] = edit->target;
    edit->added.push_back({corners, t});
  }
}

bool changesFixed(const CutComplex& complex, const ComplexEdit& edit) {
  return std::any_of(edit.removed.begin(), edit.removed.end(),
                     [&](int t) { return complex.triangles[t].is_fixed; });
}

/// The line through a vertex becomes a line through the target.
void bendLine(int vertex, const Freedom& freedom, int neighbour, ComplexEdit* edit) {
  if (freedom.kind != Freedom::Kind::kAlongLine) return;
  const int beyond = freedom.ends[0] == neighbour ? freedom.ends[1] : freedom.ends[0];
  edit->old_lines = {{vertex, neighbour}, {vertex, beyond}};
  edit->new_lines = {{edit->target, beyond}};
  if (edit->target != neighbour) edit->new_lines.push_back({edit->target, neighbour});
}

}  // namespace

Freedom freedomOf(const CutComplex& complex, int vertex) {
  if (!complex.vertices[vertex].may_leave) return {};
  FewInts<4> line;
  for (const Sheet sheet : kSheets) {
    const FewInts<4> ends = complex.lineEnds(vertex, sheet);
    if (ends.empty()) continue;
    if (ends.size() != 2) return {};
    if (!line.empty() && !(line.contains(ends[0]) && line.contains(ends[1]))) return {};
    line = ends;
  }
  if (line.empty()) return {Freedom::Kind::kAnywhere, {-1, -1}};
  return {Freedom::Kind::kAlongLine, {line[0], line[1]}};
}

bool describeFlip(const CutComplex& complex, int t, int k, ComplexEdit* edit) {
  clear(edit);
  const ComplexTriangle& triangle = complex.triangles[t];
  if (triangle.onLine(k)) return false;
  const int a = triangle.corners[k], b = triangle.corners[(k + 1) % 3], c = triangle.corners[(k + 2) % 3];
  const FewInts<4> pair = complex.trianglesAt(a, b, triangle.sheet);
  if (pair.size() != 2) return false;
  edit->removed.assign(pair.begin(), pair.end());
  if (changesFixed(complex, *edit)) return false;
  const int other = edit->removed[0] == t ? edit->removed[1] : edit->removed[0];
  const int d = complex.triangles[other].thirdCorner(a, b);
  const std::array<int, 4> all{a, b, c, d};
  const auto& vertices = complex.vertices;
  if (std::none_of(all.begin(), all.end(), [&](int v) { return vertices[v].may_leave; })) return false;
  if (!std::all_of(all.begin(), all.end(), [&](int v) { return vertices[v].is_complete; })) return false;
  edit->added = {{{a, d, c}, t}, {{b, c, d}, other}};
  edit->carriers = {{t, Eigen::Vector3d::Zero()}, {other, Eigen::Vector3d::Zero()}};
  edit->flipped = {a, b, c, d};
  return true;
}

bool describeCollapse(const CutComplex& complex, int vertex, const Freedom& freedom, int neighbour,
                      ComplexEdit* edit) {
  if (!freedom.towards(neighbour)) return false;
  clear(edit);
  edit->target = neighbour;
  replaceVertex(complex, vertex, neighbour, edit);
  if (edit->added.empty() || changesFixed(complex, *edit)) return false;
  for (const int t : edit->removed) {
    const int k = complex.triangles[t].cornerOf(neighbour);
    if (k >= 0) edit->carriers.push_back({t, Eigen::Vector3d::Unit(k)});
  }
  bendLine(vertex, freedom, neighbour, edit);
  return true;
}

bool describeSlide(const CutComplex& complex, int vertex, const Freedom& freedom, int neighbour, double share,
                   ComplexEdit* edit) {
  if (!freedom.towards(neighbour)) return false;
  clear(edit);
  edit->target = static_cast<int>(complex.vertices.size());
  edit->position = rounded(complex.at(vertex) + share * (complex.at(neighbour) - complex.at(vertex)));
  replaceVertex(complex, vertex, -1, edit);
  if (changesFixed(complex, *edit)) return false;
  for (const int t : edit->removed) {
    const int to = complex.triangles[t].cornerOf(neighbour), from = complex.triangles[t].cornerOf(vertex);
    if (to < 0) continue;
    edit->carriers.push_back(
        {t, share * Eigen::Vector3d::Unit(to) + (1.0 - share) * Eigen::Vector3d::Unit(from)});
  }
  bendLine(vertex, freedom, neighbour, edit);
  return true;
}

bool describeMove(const CutComplex& complex, int vertex, const Eigen::Vector3d& place, ComplexEdit* edit) {
  clear(edit);
  edit->target = static_cast<int>(complex.vertices.size());
  replaceVertex(complex, vertex, -1, edit);
  if (changesFixed(complex, *edit)) return false;
  for (const int t : edit->removed) {
    const ComplexTriangle& triangle = complex.triangles[t];
    const int k = triangle.cornerOf(vertex);
    const Eigen::Vector3d& origin = complex.at(vertex);
    const Eigen::Vector3d first = complex.at(triangle.corners[(k + 1) % 3]) - origin,
                          second = complex.at(triangle.corners[(k + 2) % 3]) - origin,
                          normal = first.cross(second);
    const double area = normal.squaredNorm();
    if (area <= 0.0) continue;
    Eigen::Vector3d weights;
    weights[(k + 1) % 3] = (place - origin).cross(second).dot(normal) / area;
    weights[(k + 2) % 3] = first.cross(place - origin).dot(normal) / area;
    weights[k] = 1.0 - weights[(k + 1) % 3] - weights[(k + 2) % 3];
    if (weights.minCoeff() < 0.0) continue;
    edit->carriers.push_back({t, weights});
    edit->position = rounded(origin + weights[(k + 1) % 3] * first + weights[(k + 2) % 3] * second);
    return true;
  }
  return false;
}

bool describeCutOff(const CutComplex& complex, int t, int k, ComplexEdit* edit) {
  clear(edit);
  const ComplexTriangle& triangle = complex.triangles[t];
  const int a = triangle.corners[k], b = triangle.corners[(k + 1) % 3], apex = triangle.corners[(k + 2) % 3];
  if (!triangle.onLine(k) || triangle.onLine((k + 1) % 3) || triangle.onLine((k + 2) % 3)) return false;
  if (isSeparate(triangle, k)) return false;
  const Eigen::Vector3d along = complex.at(b) - complex.at(a);
  const double share = along.dot(complex.at(apex) - complex.at(a)) / along.squaredNorm();
  if (share <= 0.0 || share >= 1.0) return false;
  splitAt(complex, t, k, share, edit);
  edit->added.erase(std::remove_if(edit->added.begin(), edit->added.end(),
                                   [t](const ComplexEdit::Added& added) { return added.parent == t; }),
                    edit->added.end());
  edit->removed.erase(std::find(edit->removed.begin(), edit->removed.end(), t));
  std::vector<int> of_edge = std::move(edit->removed);
  std::vector<ComplexEdit::Added> halves = std::move(edit->added);
  edit->added.clear();
  replaceVertex(complex, apex, -1, edit);
  edit->added.erase(std::find_if(edit->added.begin(), edit->added.end(),
                                 [t](const ComplexEdit::Added& added) { return added.parent == t; }));
  edit->removed.insert(edit->removed.end(), of_edge.begin(), of_edge.end());
  edit->added.insert(edit->added.end(), halves.begin(), halves.end());
  return !changesFixed(complex, *edit);
}

bool describeSplit(const CutComplex& complex, int triangle, int k, ComplexEdit* edit) {
  clear(edit);
  if (isSeparate(complex.triangles[triangle], k)) return false;
  splitAt(complex, triangle, k, 0.5, edit);
  return !changesFixed(complex, *edit);
}

}  // namespace softbody
