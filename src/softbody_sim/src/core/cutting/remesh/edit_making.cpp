#include "cutting/remesh/edit_making.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "cutting/remesh/edit_accuracy.h"

namespace softbody {
namespace {

/// Adds what the edges of a new triangle were in one that the edit removes.
void inheritEdges(const ComplexTriangle& old, const ComplexEdit& edit, ComplexTriangle* triangle) {
  const auto moved = [&edit](int v) { return v == edit.gone ? edit.target : v; };
  for (int k = 0; k < 3; ++k) {
    const int start = triangle->corners[k], end = triangle->corners[(k + 1) % 3];
    for (int e = 0; e < 3; ++e) {
      const int first = old.corners[e], last = old.corners[(e + 1) % 3];
      bool same = moved(first) == start && moved(last) == end;
      if (edit.split && std::minmax(first, last) == std::minmax((*edit.split)[0], (*edit.split)[1])) {
        same = (first == start && end == edit.target) || (start == edit.target && last == end);
      }
      if (!same) continue;
      triangle->lines[k] = std::max(triangle->lines[k], old.lines[e]);
      triangle->curve[k] = std::max(triangle->curve[k], old.curve[e]);
    }
  }
}

/// Texture coordinates of the target, on the side of a seam on which the parent is.
Eigen::Vector2d textureOfTarget(const CutComplex& complex, const ComplexEdit& edit, int parent) {
  const ComplexTriangle& own = complex.triangles[parent];
  const auto textureAt = [&complex](const ComplexEdit::Carrier& carrier) -> Eigen::Vector2d {
    const ComplexTriangle& triangle = complex.triangles[carrier.triangle];
    return carrier.weights[0] * triangle.texture[0] + carrier.weights[1] * triangle.texture[1] +
           carrier.weights[2] * triangle.texture[2];
  };
  const ComplexEdit::Carrier* found = nullptr;
  double nearest = std::numeric_limits<double>::infinity();
  for (const ComplexEdit::Carrier& carrier : edit.carriers) {
    if (carrier.triangle == parent) return textureAt(carrier);
    const ComplexTriangle& triangle = complex.triangles[carrier.triangle];
    const int k = triangle.cornerOf(edit.gone), own_k = own.cornerOf(edit.gone);
    if (triangle.sheet != own.sheet || k < 0 || own_k < 0) continue;
    const double distance = (triangle.texture[k] - own.texture[own_k]).norm();
    if (distance >= nearest) continue;
    nearest = distance;
    found = &carrier;
  }
  return found != nullptr ? textureAt(*found) : Eigen::Vector2d::Zero();
}

Eigen::Vector2d textureOf(const CutComplex& complex, const ComplexEdit& edit, int parent, int vertex) {
  if (vertex == edit.target) return textureOfTarget(complex, edit, parent);
  if (const int k = complex.triangles[parent].cornerOf(vertex); k >= 0) {
    return complex.triangles[parent].texture[k];
  }
  for (const ComplexEdit::Carrier& carrier : edit.carriers) {  // of a flip
    const ComplexTriangle& triangle = complex.triangles[carrier.triangle];
    if (const int k = triangle.cornerOf(vertex); k >= 0) return triangle.texture[k];
  }
  return Eigen::Vector2d::Zero();
}

ComplexTriangle inherited(const CutComplex& complex, const ComplexEdit& edit,
                          const ComplexEdit::Added& added) {
  const ComplexTriangle& parent = complex.triangles[added.parent];
  ComplexTriangle triangle;
  triangle.corners = added.corners;
  triangle.sheet = parent.sheet;
  triangle.source = parent.source;
  inheritEdges(parent, edit, &triangle);
  for (const ComplexEdit::Carrier& carrier : edit.carriers) {
    const ComplexTriangle& other = complex.triangles[carrier.triangle];
    if (carrier.triangle != added.parent && other.sheet == parent.sheet) inheritEdges(other, edit, &triangle);
  }
  if (parent.sheet == Sheet::kSkin) {
    for (int k = 0; k < 3; ++k)
      triangle.texture[k] = textureOf(complex, edit, added.parent, added.corners[k]);
  }
  return triangle;
}

/// Where a triangle with an edge on the border of the fill goes away, its other edge becomes the border.
void moveBorder(const ComplexEdit& edit, CutComplex* complex) {
  if (edit.gone < 0) return;
  for (const int t : edit.removed) {
    const ComplexTriangle& old = complex->triangles[t];
    const int k = old.cornerOf(edit.target);
    if (k < 0 || old.sheet == Sheet::kSkin || !old.onLine((k + 1) % 3)) continue;
    const int apex = old.thirdCorner(edit.gone, edit.target);
    for (const int neighbour : complex->trianglesAt(edit.target, apex, Sheet::kFill)) {
      ComplexTriangle& triangle = complex->triangles[neighbour];
      triangle.lines[triangle.edgeBetween(edit.target, apex)] = old.lines[(k + 1) % 3];
    }
  }
}

void removeTriangle(int t, CutComplex* complex) {
  for (const int v : complex->triangles[t].corners) {
    std::vector<int>& around = complex->vertices[v].triangles;
    around.erase(std::find(around.begin(), around.end(), t));
  }
  complex->triangles[t].corners = {-1, -1, -1};
}

}  // namespace

std::vector<int> makeEdit(const ComplexEdit& edit, CutComplex* complex) {
  std::vector<ComplexTriangle> made;
  made.reserve(edit.added.size());
  for (const ComplexEdit::Added& added : edit.added) made.push_back(inherited(*complex, edit, added));
  passOnSamples(edit, complex, &made);
  moveBorder(edit, complex);
  if (edit.target == static_cast<int>(complex->vertices.size())) complex->vertices.push_back({edit.position});
  for (const int t : edit.removed) removeTriangle(t, complex);
  std::vector<int> numbers;
  for (ComplexTriangle& triangle : made) {
    const auto& [a, b, c] = triangle.corners;
    triangle.shape = sineOfLeastAngle(complex->at(a), complex->at(b), complex->at(c));
    numbers.push_back(static_cast<int>(complex->triangles.size()));
    for (const int v : triangle.corners) complex->vertices[v].triangles.push_back(numbers.back());
    complex->triangles.push_back(std::move(triangle));
  }
  return numbers;
}

}  // namespace softbody
