#include "cutting/surface/surface_stitching.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "cutting/fill/cut_fill_edits.h"
#include "cutting/split/cut_refused.h"

namespace softbody {
namespace {

constexpr int kMaxRepairs = 10;  // a bound: it ends when nothing is left to repair

class Stitching {
 public:
  Stitching(const SplitSurface& surface, const CutFill& fill)
      : surface_(surface),
        fill_(fill),
        back_(3 * static_cast<int>(surface.triangles.size())),
        front_(back_ + 3 * static_cast<int>(fill.triangles.size())) {
    pairEdges();
    makeVertices();
  }

  StitchedSurface takeResult() { return std::move(result_); }

  /// Half-edges of the fill with the same two ends as another edge.
  std::vector<int> duplicateFillEdges() const;

 private:
  /// The wall at the patch's back has the triangles of the fill, the wall at its front their mirror images.
  int onBack(int h) const { return back_ + h; }
  int onFront(int h) const { return front_ + 3 * (h / 3) + 2 - h % 3; }
  void pair(int h, int g) {
    result_.mates[h] = g;
    result_.mates[g] = h;
  }
  void pairEdges();
  void makeVertices();
  std::vector<int> cornersAtCurve() const;
  void setVertex(int corner, int vertex);
  std::vector<int> surfaceEdgesBetweenWalls() const;

  const SplitSurface& surface_;
  const CutFill& fill_;
  int back_, front_;  ///< first half-edges of the walls
  StitchedSurface result_;
  std::vector<char> is_set_;  ///< per corner of the result: its vertex is set
};

void Stitching::pairEdges() {
  result_.mates = surface_.mates;
  result_.mates.resize(static_cast<std::size_t>(2 * front_ - back_), -1);
  for (int h = 0; h < front_ - back_; ++h) {
    if (const int on_curve = fill_.curve[h]; on_curve >= 0) {
      pair(onBack(h), surface_.mates[on_curve]);
      pair(onFront(h), on_curve);
    } else if (const int mate = fill_.mates[h]; mate >= 0) {
      pair(onBack(h), onBack(mate));
      pair(onFront(h), onFront(mate));
    } else {
      pair(onBack(h), onFront(h));
    }
  }
}

/// Corners of the surface at the curve's vertices, ascending.
std::vector<int> Stitching::cornersAtCurve() const {
  std::vector<int> corners;
  std::vector<char> seen(surface_.vertices.size(), 0);
  for (const int on_curve : halfEdgesOfCurve(surface_)) {
    for (const int first : {on_curve, nextHalfEdge(on_curve)}) {
      if (std::exchange(seen[startOf(surface_.triangles, first)], 1) != 0) continue;
      int h = first;
      do {
        corners.push_back(h);
        h = surface_.mates[previousHalfEdge(h)];
      } while (h != first);
    }
  }
  std::sort(corners.begin(), corners.end());
  return corners;
}

/// Sets the vertex of all corners around it.
void Stitching::setVertex(int corner, int vertex) {
  int h = corner;
  do {
    result_.triangles[h / 3][h % 3] = vertex;
    is_set_[h] = 1;
    h = result_.mates[previousHalfEdge(h)];
  } while (h != corner);
}

void Stitching::makeVertices() {
  result_.triangles = surface_.triangles;
  result_.triangles.resize(result_.mates.size() / 3, {-1, -1, -1});
  result_.vertices = surface_.vertices;
  result_.copied_from.resize(surface_.vertices.size());
  std::iota(result_.copied_from.begin(), result_.copied_from.end(), 0);
  is_set_.assign(result_.mates.size(), 0);
  const auto add = [this](const Eigen::Vector3d& position, int copied_from) {
    result_.vertices.push_back(position);
    result_.copied_from.push_back(copied_from);
    return static_cast<int>(result_.vertices.size()) - 1;
  };
  // The first corners of a vertex on the curve keep its number, corners beyond the cut get copies.
  std::vector<char> taken(surface_.vertices.size(), 0);
  for (const int h : cornersAtCurve()) {
    if (is_set_[h] != 0) continue;
    const int vertex = startOf(surface_.triangles, h);
    const bool is_first = std::exchange(taken[vertex], 1) == 0;
    setVertex(h, is_first ? vertex : add(surface_.vertices[vertex], vertex));
  }
  for (int h = 0; h < front_ - back_; ++h) {
    const int start = startOf(fill_.triangles, h), end = endOf(fill_.triangles, h);
    if (is_set_[onBack(h)] == 0) setVertex(onBack(h), add(fill_.points[start], -1));
    if (is_set_[onFront(h)] == 0) setVertex(onFront(h), add(fill_.points[end], -1));
  }
}

std::vector<int> Stitching::duplicateFillEdges() const {
  std::map<std::array<int, 2>, int> edges;
  std::vector<int> duplicates;
  const auto examine = [&](int h, int fill_edge) {
    const std::array<int, 2> ends{startOf(result_.triangles, h), endOf(result_.triangles, h)};
    const auto [entry, is_new] = edges.emplace(ends, fill_edge);
    if (is_new) return;
    const int interior = fill_edge >= 0 ? fill_edge : entry->second;
    if (interior < 0)
      throw CutRefused("the cut would leave two edges of the surface between the same vertices");
    duplicates.push_back(interior);
  };
  for (int h = 0; h < front_ - back_; ++h) {
    const int fill_edge = fill_.mates[h] >= 0 ? std::max(h, fill_.mates[h]) : -1;
    examine(onBack(h), fill_edge);
    examine(onFront(h), fill_edge);
  }
  for (const int h : surfaceEdgesBetweenWalls()) examine(h, -1);
  std::sort(duplicates.begin(), duplicates.end());
  duplicates.erase(std::unique(duplicates.begin(), duplicates.end()), duplicates.end());
  return duplicates;
}

/// Half-edges of the surface's triangles that run between vertices of the walls.
std::vector<int> Stitching::surfaceEdgesBetweenWalls() const {
  std::vector<char> on_wall(result_.vertices.size(), 0);
  for (std::size_t t = static_cast<std::size_t>(back_) / 3; t < result_.triangles.size(); ++t) {
    for (const int v : result_.triangles[t]) on_wall[v] = 1;
  }
  std::vector<int> found;
  std::vector<char> seen(result_.vertices.size(), 0);
  for (int corner = back_; corner < static_cast<int>(result_.mates.size()); ++corner) {
    if (std::exchange(seen[startOf(result_.triangles, corner)], 1) != 0) continue;
    int h = corner;
    do {
      if (h < back_ && on_wall[endOf(result_.triangles, h)] != 0) found.push_back(h);
      h = result_.mates[previousHalfEdge(h)];
    } while (h != corner);
  }
  return found;
}

}  // namespace

StitchedSurface stitch(const SplitSurface& surface, CutFill fill) {
  for (int repair = 0; repair < kMaxRepairs; ++repair) {
    Stitching stitching(surface, fill);
    const std::vector<int> duplicates = stitching.duplicateFillEdges();
    if (duplicates.empty()) return stitching.takeResult();
    for (const int h : duplicates) splitFillEdge(h, &fill);
  }
  throw CutRefused("the cut would leave edges of its faces between the same vertices");
}

}  // namespace softbody
