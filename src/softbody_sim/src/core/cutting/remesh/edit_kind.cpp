#include "cutting/remesh/edit_kind.h"

#include <algorithm>

namespace softbody {
namespace {

/// The vertices that form a triangle with both ends of an edge are the only common neighbours of these ends,
/// and no two of them form a triangle with the neighbour that replaces the vertex.
bool linksAgree(const CutComplex& complex, int vertex, int neighbour, Sheet sheet) {
  FewInts<4> apexes, common;
  for (const int t : complex.trianglesAt(vertex, neighbour, sheet)) {
    apexes.add(complex.triangles[t].thirdCorner(vertex, neighbour));
  }
  for (const int t : complex.vertices[vertex].triangles) {
    if (complex.triangles[t].sheet != sheet) continue;
    for (const int v : complex.triangles[t].corners) {
      if (v == vertex || v == neighbour || common.contains(v)) continue;
      if (complex.adjacent(v, neighbour, sheet)) common.add(v);
    }
  }
  if (common.size() != apexes.size()) return false;
  return apexes.size() < 2 ||
         std::none_of(complex.vertices[neighbour].triangles.begin(),
                      complex.vertices[neighbour].triangles.end(), [&](int t) {
                        const ComplexTriangle& triangle = complex.triangles[t];
                        return triangle.sheet == sheet && triangle.cornerOf(vertex) < 0 &&
                               triangle.cornerOf(apexes[0]) >= 0 && triangle.cornerOf(apexes[1]) >= 0;
                      });
}

/// Of two edges that a collapse merges, at most one is part of a line.
bool linesStayApart(const CutComplex& complex, int vertex, int neighbour, Sheet sheet) {
  for (const int t : complex.trianglesAt(vertex, neighbour, sheet)) {
    const ComplexTriangle& triangle = complex.triangles[t];
    const int at_vertex = triangle.cornerOf(vertex), at_neighbour = triangle.cornerOf(neighbour);
    // The edge opposite of a corner starts at the next one.
    const bool of_vertex = triangle.onLine((at_neighbour + 1) % 3);
    const bool of_neighbour = triangle.onLine((at_vertex + 1) % 3);
    if (of_vertex && (of_neighbour || sheet == Sheet::kSkin)) return false;
  }
  return true;
}

/// An end of the curve, where the body does not open. Two of them must not be joined on the skin: the faces
/// of the cut join them, too.
bool endsCurve(const CutComplex& complex, int vertex) {
  return complex.lineEnds(vertex, Sheet::kSkin, Line::kCurve).size() == 1;
}

bool joinsEnds(const CutComplex& complex, int vertex, const std::vector<int>& triangles) {
  if (!endsCurve(complex, vertex)) return false;
  for (const int t : triangles) {
    if (complex.triangles[t].sheet == Sheet::kFill) continue;
    for (const int v : complex.triangles[t].corners) {
      if (v != vertex && endsCurve(complex, v) && !complex.adjacent(v, vertex, Sheet::kSkin)) return true;
    }
  }
  return false;
}

/// Both triangles of a flip join vertices that have no edge yet.
bool flipKeepsKind(const CutComplex& complex, const ComplexEdit& edit) {
  const auto& [a, b, c, d] = *edit.flipped;
  const Sheet sheet = complex.triangles[edit.removed.front()].sheet;
  return !complex.adjacent(c, d, sheet) && !(sheet == Sheet::kSkin && joinsEnds(complex, c, edit.removed));
}

/// The two triangles at the split edge share no other edge with the vertex that is cut off.
bool cutOffKeepsKind(const CutComplex& complex, const ComplexEdit& edit) {
  const auto& [a, b] = *edit.split;
  const Sheet sheet = complex.triangles[complex.vertices[edit.gone].triangles.front()].sheet;
  for (const int t : complex.trianglesAt(a, b, sheet)) {
    const int third = complex.triangles[t].thirdCorner(a, b);
    if (third != edit.gone && complex.adjacent(edit.gone, third, sheet)) return false;
  }
  return true;
}

bool collapseKeepsKind(const CutComplex& complex, const ComplexEdit& edit) {
  if (joinsEnds(complex, edit.target, edit.removed)) return false;
  return std::all_of(kSheets.begin(), kSheets.end(), [&](Sheet sheet) {
    return !complex.hasSheet(edit.gone, sheet) || (linksAgree(complex, edit.gone, edit.target, sheet) &&
                                                   linesStayApart(complex, edit.gone, edit.target, sheet));
  });
}

}  // namespace

bool keepsKind(const CutComplex& complex, const ComplexEdit& edit) {
  if (edit.flipped) return flipKeepsKind(complex, edit);
  if (edit.gone < 0) return true;
  if (edit.split) return cutOffKeepsKind(complex, edit);
  return edit.target == static_cast<int>(complex.vertices.size()) || collapseKeepsKind(complex, edit);
}

}  // namespace softbody
