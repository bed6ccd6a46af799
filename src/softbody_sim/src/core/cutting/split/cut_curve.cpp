#include "cutting/split/cut_curve.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <map>

#include "cutting/patch/patch_intersector.h"
#include "cutting/patch/patch_slab.h"
#include "cutting/split/cut_refused.h"

namespace softbody {
namespace {

using Corners = std::array<Eigen::Vector3d, 3>;

/// The side of the plane (a, b, c) on which d lies: +1 on the side of the normal, exactly.
int side(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
         const Eigen::Vector3d& d) {
  using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
  const auto point = [](const Eigen::Vector3d& p) { return Point(p.x(), p.y(), p.z()); };
  const CGAL::Orientation orientation = CGAL::orientation(point(a), point(b), point(c), point(d));
  if (orientation == CGAL::COPLANAR) throw CutRefused("the patch touches the surface without crossing it");
  return orientation == CGAL::POSITIVE ? 1 : -1;
}

std::array<int, 3> sidesOf(const Corners& plane, const Corners& points) {
  std::array<int, 3> sides;
  for (int k = 0; k < 3; ++k) sides[k] = side(plane[0], plane[1], plane[2], points[k]);
  return sides;
}

bool onOneSide(const std::array<int, 3>& sides) { return sides[0] == sides[1] && sides[1] == sides[2]; }

/// A fast test that avoids the exact predicates for most pairs.
bool clearlyOnOneSide(const Corners& plane, const Corners& points) {
  constexpr double kRounding = 1e-12;  // far above that of a product of doubles
  const Eigen::Vector3d first = plane[1] - plane[0], second = plane[2] - plane[0],
                        normal = first.cross(second);
  const double scale = first.norm() * second.norm();
  int above = 0, below = 0;
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector3d place = point - plane[0];
    const double height = normal.dot(place), margin = kRounding * scale * (place.norm() + point.norm());
    above += height > margin;
    below += height < -margin;
  }
  return above == 3 || below == 3;
}

/// Whether a line that crosses the plane of a triangle passes through the triangle.
bool passesThrough(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Corners& triangle) {
  const int first = side(a, b, triangle[0], triangle[1]);
  return side(a, b, triangle[1], triangle[2]) == first && side(a, b, triangle[2], triangle[0]) == first;
}

bool precedes(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

/// The fraction at which the segment from a to b crosses a plane. Independent of the order of the corners:
/// both walls of an earlier cut are crossed at exactly the same places.
double crossingFraction(const Eigen::Vector3d& a, const Eigen::Vector3d& b, Corners plane) {
  std::sort(plane.begin(), plane.end(), precedes);
  const Eigen::Vector3d normal = (plane[1] - plane[0]).cross(plane[2] - plane[0]);
  const double height_a = normal.dot(a - plane[0]), height_b = normal.dot(b - plane[0]);
  return std::clamp(height_a / (height_a - height_b), 0.0, 1.0);
}

class Intersection {
 public:
  Intersection(const Points& vertices, const TriangleList& triangles, const std::vector<int>& mates,
               const PatchFacets& facets)
      : vertices_(vertices), triangles_(triangles), mates_(mates), facets_(facets) {}

  CutCurve run();

 private:
  Corners meshCorners(int t) const {
    return {vertices_.row(triangles_[t][0]), vertices_.row(triangles_[t][1]),
            vertices_.row(triangles_[t][2])};
  }
  Corners patchCorners(int p) const {
    const CutPatch& patch = facets_.patch;
    return {patch.vertices.row(patch.triangles(p, 0)), patch.vertices.row(patch.triangles(p, 1)),
            patch.vertices.row(patch.triangles(p, 2))};
  }
  void intersectPair(int t, int p);
  int crossing(int half_edge, int p, const Corners& patch);
  int piercing(int patch_edge, int t, const Corners& mesh);
  void joinOverFlatEdges();

  const Points& vertices_;
  const TriangleList& triangles_;
  const std::vector<int>& mates_;
  const PatchFacets& facets_;
  CutCurve curve_;
  std::map<std::pair<int, int>, int> crossings_;  ///< (mesh edge, patch triangle) -> node
  std::map<std::pair<int, int>, int> piercings_;  ///< (patch edge, mesh triangle) -> node
};

CutCurve Intersection::run() {
  const PatchIntersector patch(facets_.patch);
  const std::vector<signed char> sides = PatchSlab(facets_.patch).sidesOf(vertices_);
  Eigen::AlignedBox3d whole;
  for (const auto& vertex : facets_.patch.vertices.rowwise()) whole.extend(vertex.transpose());
  for (int t = 0; t < static_cast<int>(triangles_.size()); ++t) {
    const auto& [a, b, c] = triangles_[t];
    if (sides[a] != 0 && sides[a] == sides[b] && sides[b] == sides[c]) continue;
    Eigen::AlignedBox3d box;
    for (const int vertex : triangles_[t]) box.extend(vertices_.row(vertex).transpose());
    if (!box.intersects(whole)) continue;
    for (const int p : patch.trianglesNear(box)) intersectPair(t, p);
  }
  joinOverFlatEdges();
  return std::move(curve_);
}

void Intersection::intersectPair(int t, int p) {
  const Corners mesh = meshCorners(t), patch = patchCorners(p);
  if (clearlyOnOneSide(patch, mesh)) return;
  const std::array<int, 3> mesh_sides = sidesOf(patch, mesh);
  if (onOneSide(mesh_sides)) return;
  const std::array<int, 3> patch_sides = sidesOf(mesh, patch);
  if (onOneSide(patch_sides)) return;
  CurveSegment segment{t, facets_.facets[p], -1, -1};
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    if (mesh_sides[k] != mesh_sides[next] && passesThrough(mesh[k], mesh[next], patch)) {
      (mesh_sides[k] < 0 ? segment.to : segment.from) = crossing(3 * t + k, p, patch);
    }
    if (patch_sides[k] != patch_sides[next] && passesThrough(patch[k], patch[next], mesh)) {
      (patch_sides[k] > 0 ? segment.to : segment.from) = piercing(facets_.triangle_edges[p][k], t, mesh);
    }
  }
  if (segment.from >= 0 && segment.to >= 0) curve_.segments.push_back(segment);
}

int Intersection::crossing(int half_edge, int p, const Corners& patch) {
  const int edge = std::min(half_edge, mates_[half_edge]);
  const auto [entry, is_new] = crossings_.emplace(std::pair(edge, p), static_cast<int>(curve_.nodes.size()));
  if (is_new) {
    const Eigen::Vector3d start = vertices_.row(startOf(triangles_, edge)),
                          end = vertices_.row(endOf(triangles_, edge));
    const bool forward = precedes(start, end);
    const Eigen::Vector3d &low = forward ? start : end, &high = forward ? end : start;
    const double fraction = crossingFraction(low, high, patch);
    curve_.nodes.push_back({edge, -1, forward ? fraction : 1.0 - fraction, low + fraction * (high - low)});
  }
  return entry->second;
}

int Intersection::piercing(int patch_edge, int t, const Corners& mesh) {
  const auto [entry, is_new] =
      piercings_.emplace(std::pair(patch_edge, t), static_cast<int>(curve_.nodes.size()));
  if (is_new) {
    const PatchEdge& edge = facets_.edges[patch_edge];
    const Eigen::Vector3d start = facets_.patch.vertices.row(edge.first),
                          end = facets_.patch.vertices.row(edge.second);
    const double fraction = crossingFraction(start, end, mesh);
    curve_.nodes.push_back({-1, patch_edge, fraction, start + fraction * (end - start)});
  }
  return entry->second;
}

/// At an edge inside a facet the curve is straight: joins the two segments there.
void Intersection::joinOverFlatEdges() {
  const auto isFlat = [this](int node) {
    return curve_.nodes[node].patch_edge >= 0 && !facets_.edges[curve_.nodes[node].patch_edge].fold;
  };
  std::vector<int> segment_from(curve_.nodes.size(), -1);
  for (std::size_t s = 0; s < curve_.segments.size(); ++s) {
    if (isFlat(curve_.segments[s].from)) segment_from[curve_.segments[s].from] = static_cast<int>(s);
  }
  std::vector<CurveSegment> joined;
  for (CurveSegment segment : curve_.segments) {
    if (isFlat(segment.from)) continue;
    while (isFlat(segment.to)) segment.to = curve_.segments[segment_from[segment.to]].to;
    joined.push_back(segment);
  }
  curve_.segments = std::move(joined);
}

}  // namespace

CutCurve intersect(const Points& vertices, const TriangleList& triangles, const std::vector<int>& mates,
                   const PatchFacets& facets) {
  return Intersection(vertices, triangles, mates, facets).run();
}

}  // namespace softbody
