#include "bodies/polygon.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>

namespace softbody::virtual_camera {
namespace {

using Corners = std::array<int, 3>;
using Polygon = std::vector<Eigen::Vector2d>;

double doubleArea(const Polygon& p, const Corners& t) {
  const Eigen::Vector2d ab = p[t[1]] - p[t[0]], ac = p[t[2]] - p[t[0]];
  return ab.x() * ac.y() - ab.y() * ac.x();
}

/// The smallest height of a triangle; negative for a clockwise triangle.
double height(const Polygon& p, const Corners& t) {
  const double longest = std::max({(p[t[1]] - p[t[0]]).squaredNorm(), (p[t[2]] - p[t[1]]).squaredNorm(),
                                   (p[t[0]] - p[t[2]]).squaredNorm()});
  return doubleArea(p, t) / std::sqrt(longest);
}

/// Whether no other remaining vertex is in the triangle or, up to rounding, on its edges.
bool isEar(const Polygon& p, const std::vector<int>& left, const Corners& t) {
  const double rounding = -1e-10 * doubleArea(p, t);
  return std::none_of(left.begin(), left.end(), [&](int i) {
    if (i == t[0] || i == t[1] || i == t[2]) return false;
    return doubleArea(p, {t[0], t[1], i}) >= rounding && doubleArea(p, {t[1], t[2], i}) >= rounding &&
           doubleArea(p, {t[2], t[0], i}) >= rounding;
  });
}

/// Clips the highest ear. @return its corners.
Corners clipEar(const Polygon& p, std::vector<int>* left) {
  const std::size_t n = left->size();
  std::vector<std::pair<double, std::size_t>> candidates;
  const auto corners = [&](std::size_t i) {
    return Corners{(*left)[(i + n - 1) % n], (*left)[i], (*left)[(i + 1) % n]};
  };
  for (std::size_t i = 0; i < n; ++i) candidates.emplace_back(-height(p, corners(i)), i);
  std::sort(candidates.begin(), candidates.end());
  for (const auto& [negative_height, i] : candidates) {
    const Corners ear = corners(i);
    if (negative_height >= 0.0 || !isEar(p, *left, ear)) continue;
    left->erase(left->begin() + static_cast<std::ptrdiff_t>(i));
    return ear;
  }
  throw std::invalid_argument("the polygon is not simple and counter-clockwise");
}

/// Flips the edge between two triangles if this increases the smaller height.
bool improve(const Polygon& p, Corners* first, Corners* second) {
  for (int k = 0; k < 3; ++k) {
    const int a = (*first)[k], b = (*first)[(k + 1) % 3], c = (*first)[(k + 2) % 3];
    for (int j = 0; j < 3; ++j) {
      if ((*second)[j] != b || (*second)[(j + 1) % 3] != a) continue;
      const int d = (*second)[(j + 2) % 3];
      const Corners one = {a, d, c}, two = {d, b, c};
      const double now = std::min(height(p, *first), height(p, *second)),
                   then = std::min(height(p, one), height(p, two));
      if (then <= now * (1.0 + 1e-9)) return false;
      *first = one;
      *second = two;
      return true;
    }
  }
  return false;
}

/// Flips the first edge that improves the triangles. @return whether there was one.
bool improveOne(const Polygon& p, std::vector<Corners>* triangles) {
  std::map<std::pair<int, int>, std::size_t> owner;  // of a directed edge
  for (std::size_t f = 0; f < triangles->size(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const Corners t = (*triangles)[f];
      const auto twin = owner.find({t[(k + 1) % 3], t[k]});
      if (twin != owner.end() && improve(p, &(*triangles)[f], &(*triangles)[twin->second])) return true;
      owner[{t[k], t[(k + 1) % 3]}] = f;
    }
  }
  return false;
}

}  // namespace

std::vector<Corners> triangulatePolygon(const Polygon& polygon) {
  std::vector<int> left(polygon.size());
  std::iota(left.begin(), left.end(), 0);
  std::vector<Corners> triangles;
  while (left.size() >= 3) triangles.push_back(clipEar(polygon, &left));
  while (improveOne(polygon, &triangles)) continue;
  return triangles;
}

}  // namespace softbody::virtual_camera
