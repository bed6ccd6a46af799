#include "cutting/fill/cut_fill_edits.h"

#include "cutting/split/curve_snapping.h"

namespace softbody {
namespace {

constexpr int kMaxPasses = 20;  // a bound: it ends when nothing changes

double heightOf(const CutFill& fill, int a, int b, int c) {
  return smallestHeight(fill.points[a], fill.points[b], fill.points[c]);
}

int longestEdge(const CutFill& fill, int triangle) {
  int longest = 3 * triangle;
  double length = 0.0;
  for (int h = 3 * triangle; h < 3 * triangle + 3; ++h) {
    const double own =
        (fill.points[endOf(fill.triangles, h)] - fill.points[startOf(fill.triangles, h)]).norm();
    if (own > length) length = own, longest = h;
  }
  return longest;
}

/// Sets mate and curve of a half-edge.
void placeEdge(int h, int mate, int curve, CutFill* fill) {
  fill->mates[h] = mate;
  fill->curve[h] = curve;
  if (mate >= 0) fill->mates[mate] = h;
}

/// (a, b, c) and (b, a, d) become (a, d, c) and (b, c, d).
void flip(int h, CutFill* fill) {
  const int g = fill->mates[h], f = h / 3, e = g / 3;
  const int h1 = nextHalfEdge(h), h2 = previousHalfEdge(h), g1 = nextHalfEdge(g), g2 = previousHalfEdge(g);
  const int a = startOf(fill->triangles, h), b = startOf(fill->triangles, g);
  const int c = startOf(fill->triangles, h2), d = startOf(fill->triangles, g2);
  const std::array<int, 4> outer{g1, h2, h1, g2}, places{3 * f, 3 * f + 2, 3 * e, 3 * e + 2};
  std::array<int, 4> mates, curves;
  for (int k = 0; k < 4; ++k) mates[k] = fill->mates[outer[k]], curves[k] = fill->curve[outer[k]];
  fill->triangles[f] = {a, d, c};
  fill->triangles[e] = {b, c, d};
  for (int k = 0; k < 4; ++k) placeEdge(places[k], mates[k], curves[k], fill);
  placeEdge(3 * f + 1, 3 * e + 1, -1, fill);
  fill->curve[3 * e + 1] = -1;
}

bool improveByFlip(int h, const PatchFacets& facets, CutFill* fill) {
  const int g = fill->mates[h];
  if (g < 0 || fill->facets[h / 3] != fill->facets[g / 3]) return false;
  const int a = startOf(fill->triangles, h), b = startOf(fill->triangles, g);
  const int c = startOf(fill->triangles, previousHalfEdge(h)),
            d = startOf(fill->triangles, previousHalfEdge(g));
  const PlaneFrame& frame = facets.frames[fill->facets[h / 3]];
  const auto isLeft = [&](int p, int q, int r) {
    const Eigen::Vector3d first = fill->points[q] - fill->points[p],
                          second = fill->points[r] - fill->points[p];
    return first.cross(second).dot(frame.x_axis.cross(frame.y_axis)) > 0.0;
  };
  if (!isLeft(a, d, c) || !isLeft(b, c, d)) return false;
  if (std::min(heightOf(*fill, a, d, c), heightOf(*fill, b, c, d)) <=
      std::min(heightOf(*fill, a, b, c), heightOf(*fill, b, a, d))) {
    return false;
  }
  flip(h, fill);
  return true;
}

}  // namespace

void raiseLowTriangles(double limit, const PatchFacets& facets, CutFill* fill) {
  bool changed = true;
  for (int pass = 0; changed && pass < kMaxPasses; ++pass) {
    changed = false;
    for (int t = 0; t < static_cast<int>(fill->triangles.size()); ++t) {
      const auto& [a, b, c] = fill->triangles[t];
      if (heightOf(*fill, a, b, c) >= limit) continue;
      if (improveByFlip(longestEdge(*fill, t), facets, fill)) changed = true;
    }
  }
}

void splitFillEdge(int half_edge, CutFill* fill) {
  const int mate = fill->mates[half_edge], middle = static_cast<int>(fill->points.size());
  fill->points.push_back(0.5 * (fill->points[startOf(fill->triangles, half_edge)] +
                                fill->points[startOf(fill->triangles, mate)]));
  const auto halve = [fill, middle](int h) {
    const int second = nextHalfEdge(h), added = static_cast<int>(fill->triangles.size());
    fill->triangles.push_back({middle, startOf(fill->triangles, second), endOf(fill->triangles, second)});
    fill->facets.push_back(fill->facets[h / 3]);
    fill->curve.resize(fill->triangles.size() * 3, -1);
    fill->mates.resize(fill->triangles.size() * 3, -1);
    placeEdge(3 * added + 1, fill->mates[second], fill->curve[second], fill);
    fill->triangles[h / 3][second % 3] = middle;
    placeEdge(second, 3 * added + 2, -1, fill);
    return added;
  };
  const int beyond = halve(half_edge), beyond_mate = halve(mate);
  placeEdge(half_edge, 3 * beyond_mate, -1, fill);
  placeEdge(mate, 3 * beyond, -1, fill);
}

}  // namespace softbody
