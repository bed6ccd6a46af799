#include "cutting/split/curve_snapping.h"

#include <algorithm>
#include <map>

#include "cutting/split/surface_edits.h"

namespace softbody {
namespace {

constexpr int kMaxPasses = 20;  // a bound: it ends when nothing changes

class Snapping {
 public:
  Snapping(double distance, SplitSurface* surface) : distance_(distance), surface_(*surface) {}

  void run() {
    bool changed = true;
    for (int pass = 0; changed && pass < kMaxPasses; ++pass) {
      changed = false;
      const std::size_t count =
          surface_.changed.size();  // bent edges append further triangles, for the next pass
      for (std::size_t k = 0; k < count; ++k) {
        if (surface_.used(surface_.changed[k]) && improve(surface_.changed[k])) changed = true;
      }
    }
  }

 private:
  const Eigen::Vector3d& start(int h) const { return surface_.vertices[startOf(surface_.triangles, h)]; }
  double lengthOf(int h) const { return (start(nextHalfEdge(h)) - start(h)).norm(); }
  bool isOwn(int h) const { return startOf(surface_.triangles, h) < surface_.own_vertices; }
  bool improve(int triangle);
  bool collapse(int h);
  bool mayMove(int h) const;
  bool bend(int h);

  double distance_;
  SplitSurface& surface_;
};

bool Snapping::improve(int triangle) {
  int shortest = 3 * triangle, longest = 3 * triangle;
  for (int h = 3 * triangle + 1; h < 3 * triangle + 3; ++h) {
    if (lengthOf(h) < lengthOf(shortest)) shortest = h;
    if (lengthOf(h) > lengthOf(longest)) longest = h;
  }
  if (lengthOf(shortest) < distance_) return collapse(shortest);
  if (smallestHeight(start(3 * triangle), start(3 * triangle + 1), start(3 * triangle + 2)) <
      0.5 * distance_) {
    return bend(longest);
  }
  return false;
}

/// The mesh's own vertices stay. Of two new ones the lower by coordinates stays, so that both walls of an
/// earlier cut are treated alike.
bool Snapping::collapse(int h) {
  int mate = surface_.mates[h];
  if (isOwn(h) && isOwn(mate)) return false;
  const bool mate_first = std::lexicographical_compare(start(mate).data(), start(mate).data() + 3,
                                                       start(h).data(), start(h).data() + 3);
  if (isOwn(h) || (!isOwn(mate) && !mate_first)) std::swap(h, mate);
  if (mayMove(h) && collapseEdge(h, &surface_)) return true;
  return !isOwn(mate) && mayMove(mate) && collapseEdge(mate, &surface_);
}

/// Whether no triangle turns over when the half-edge's start moves to its end.
bool Snapping::mayMove(int half_edge) const {
  const Eigen::Vector3d& target = start(nextHalfEdge(half_edge));
  for (int h = surface_.mates[previousHalfEdge(half_edge)]; h != half_edge;
       h = surface_.mates[previousHalfEdge(h)]) {
    if (surface_.mates[previousHalfEdge(h)] == half_edge) break;  // vanishes
    const Eigen::Vector3d &second = start(nextHalfEdge(h)), &third = start(previousHalfEdge(h));
    const Eigen::Vector3d before = (second - start(h)).cross(third - start(h));
    const Eigen::Vector3d after = (second - target).cross(third - target);
    if (smallestHeight(start(h), second, third) > 0.5 * distance_ && before.dot(after) <= 0.0) return false;
  }
  return true;
}

/// Only if the lower one of the two triangles becomes higher: otherwise it might never end.
bool Snapping::bend(int h) {
  const Eigen::Vector3d &a = start(h), &b = start(nextHalfEdge(h)), &apex = start(previousHalfEdge(h));
  const Eigen::Vector3d& opposite = start(previousHalfEdge(surface_.mates[h]));
  if (std::min(smallestHeight(a, opposite, apex), smallestHeight(b, apex, opposite)) <=
      std::min(smallestHeight(a, b, apex), smallestHeight(b, a, opposite))) {
    return false;
  }
  const Eigen::Vector3d edge = start(nextHalfEdge(h)) - start(h);
  const double along = edge.dot(start(previousHalfEdge(h)) - start(h)) / edge.squaredNorm();
  const int mate_triangle = surface_.mates[h] / 3;
  if (!bendEdgeToApex(h, along, &surface_)) return false;
  surface_.changed.push_back(mate_triangle);
  return true;
}

}  // namespace

double smallestHeight(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const double longest =
      std::sqrt(std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()}));
  return longest > 0.0 ? (b - a).cross(c - a).norm() / longest : 0.0;
}

void snapCurve(double distance, SplitSurface* surface) { Snapping(distance, surface).run(); }

void splitLoneSegments(SplitSurface* surface) {
  std::map<int, int> segments_at;  // vertex -> number of segments of the curve
  const std::vector<int> segments = halfEdgesOfCurve(*surface);
  for (const int h : segments) {
    ++segments_at[startOf(surface->triangles, h)];
    ++segments_at[endOf(surface->triangles, h)];
  }
  for (const int h : segments) {
    if (segments_at[startOf(surface->triangles, h)] == 1 && segments_at[endOf(surface->triangles, h)] == 1) {
      splitEdge(h, surface);
    }
  }
}

}  // namespace softbody
