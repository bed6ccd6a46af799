#include "cutting/remesh/cut_complex.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace softbody {

int ComplexTriangle::cornerOf(int vertex) const {
  for (int k = 0; k < 3; ++k) {
    if (corners[k] == vertex) return k;
  }
  return -1;
}

int ComplexTriangle::thirdCorner(int a, int b) const {
  for (const int v : corners) {
    if (v != a && v != b) return v;
  }
  return -1;
}

int ComplexTriangle::edgeBetween(int a, int b) const { return (cornerOf(thirdCorner(a, b)) + 1) % 3; }

FewInts<4> CutComplex::trianglesAt(int a, int b, Sheet sheet) const {
  FewInts<4> found;
  for (const int t : vertices[a].triangles) {
    if (triangles[t].sheet == sheet && triangles[t].cornerOf(b) >= 0) found.add(t);
  }
  return found;
}

bool CutComplex::adjacent(int a, int b, Sheet sheet) const {
  return std::any_of(vertices[a].triangles.begin(), vertices[a].triangles.end(),
                     [&](int t) { return triangles[t].sheet == sheet && triangles[t].cornerOf(b) >= 0; });
}

bool CutComplex::hasSheet(int vertex, Sheet sheet) const {
  return std::any_of(vertices[vertex].triangles.begin(), vertices[vertex].triangles.end(),
                     [&](int t) { return triangles[t].sheet == sheet; });
}

FewInts<4> CutComplex::lineEnds(int vertex, Sheet sheet, Line least) const {
  FewInts<4> ends;
  const auto add = [&ends](int end) {
    if (!ends.contains(end)) ends.add(end);
  };
  for (const int t : vertices[vertex].triangles) {
    const ComplexTriangle& triangle = triangles[t];
    if (triangle.sheet != sheet) continue;
    const int k = triangle.cornerOf(vertex), before = (k + 2) % 3;
    if (triangle.lines[k] >= least) add(triangle.corners[(k + 1) % 3]);
    if (triangle.lines[before] >= least) add(triangle.corners[before]);
  }
  return ends;
}

Eigen::Vector3d CutComplex::normalOf(const ComplexTriangle& triangle) const {
  const Eigen::Vector3d& origin = at(triangle.corners[0]);
  return (at(triangle.corners[1]) - origin).cross(at(triangle.corners[2]) - origin);
}

double sineOfLeastAngle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const double ab = (b - a).squaredNorm(), bc = (c - b).squaredNorm(), ca = (a - c).squaredNorm();
  const double sides = ab * bc * ca;
  if (sides <= 0.0) return 0.0;
  // The least angle is between the two longest sides.
  return std::sqrt((b - a).cross(c - a).squaredNorm() * std::min({ab, bc, ca}) / sides);
}

}  // namespace softbody
