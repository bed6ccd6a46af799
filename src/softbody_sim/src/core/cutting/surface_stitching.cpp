#include "core/cutting/surface_stitching.h"

#include <algorithm>
#include <map>

#include "core/cutting/cut_refused.h"

namespace softbody {
namespace {

constexpr int kMaxRepairs = 10;

class Stitching {
 public:
  Stitching(const SplitSurface& surface, const WallFill& fill)
      : surface_(surface),
        fill_(fill),
        back_(3 * static_cast<int>(surface.triangles.size())),
        front_(back_ + 3 * static_cast<int>(fill.triangles.size())) {
    pairEdges();
    makeVertices();
  }

  const StitchedSurface& result() const { return result_; }

  /// Half-edges of the fill that lie between the same two vertices as another edge.
  std::vector<int> doubledFillEdges() const;

 private:
  /// The wall on the patch's back is made of the fill's triangles, that on its front of their mirror images.
  int onBack(int h) const { return back_ + h; }
  int onFront(int h) const { return front_ + 3 * (h / 3) + 2 - h % 3; }
  void pair(int h, int g) {
    result_.mates[h] = g;
    result_.mates[g] = h;
  }
  void pairEdges();
  void makeVertices();
  void nameCorners(int corner, int vertex);

  const SplitSurface& surface_;
  const WallFill& fill_;
  int back_, front_;  ///< first half-edges of the walls
  StitchedSurface result_;
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

/// Gives a vertex to all corners round it.
void Stitching::nameCorners(int corner, int vertex) {
  int h = corner;
  do {
    result_.triangles[h / 3][h % 3] = vertex;
    h = result_.mates[previousHalfEdge(h)];
  } while (h != corner);
}

void Stitching::makeVertices() {
  const int count = static_cast<int>(result_.mates.size());
  std::vector<bool> on_curve(surface_.vertices.size(), false);
  result_.triangles = surface_.triangles;
  result_.triangles.resize(static_cast<std::size_t>(count / 3), {-1, -1, -1});
  result_.vertices = surface_.vertices;
  for (std::size_t v = 0; v < surface_.vertices.size(); ++v)
    result_.copied_from.push_back(static_cast<int>(v));
  for (int h = 0; h < back_; ++h) {
    if (surface_.used(h / 3) && surface_.curve[h] >= 0) {
      on_curve[startOf(surface_.triangles, h)] = on_curve[endOf(surface_.triangles, h)] = true;
    }
  }
  // The first corners of a vertex on the curve keep its number, those beyond the cut get copies.
  std::vector<bool> taken(surface_.vertices.size(), false);
  std::vector<bool> named(static_cast<std::size_t>(count), false);
  const auto add = [this](const Eigen::Vector3d& position, int copied_from) {
    result_.vertices.push_back(position);
    result_.copied_from.push_back(copied_from);
    return static_cast<int>(result_.vertices.size()) - 1;
  };
  const auto visit = [&](int h, int vertex_of_surface, const Eigen::Vector3d& position) {
    if (named[h]) return;
    int vertex = vertex_of_surface;
    if (vertex < 0 || taken[vertex]) vertex = add(position, vertex_of_surface);
    if (vertex_of_surface >= 0) taken[vertex_of_surface] = true;
    int g = h;
    do {
      named[g] = true;
      g = result_.mates[previousHalfEdge(g)];
    } while (g != h);
    nameCorners(h, vertex);
  };
  for (int h = 0; h < back_; ++h) {
    if (!surface_.used(h / 3)) continue;
    const int vertex = startOf(surface_.triangles, h);
    if (on_curve[vertex]) visit(h, vertex, surface_.vertices[vertex]);
  }
  for (int h = 0; h < front_ - back_; ++h) {
    visit(onBack(h), -1, fill_.points[startOf(fill_.triangles, h)]);
    visit(onFront(h), -1, fill_.points[endOf(fill_.triangles, h)]);
  }
}

std::vector<int> Stitching::doubledFillEdges() const {
  std::map<std::array<int, 2>, int> edges;
  std::vector<int> doubled;
  const auto examine = [&](int h, int fill_edge) {
    const std::array<int, 2> ends{startOf(result_.triangles, h), endOf(result_.triangles, h)};
    const auto [entry, is_new] = edges.emplace(ends, fill_edge);
    if (is_new) return;
    const int interior = fill_edge >= 0 ? fill_edge : entry->second;
    if (interior < 0)
      throw CutRefused("the cut would leave two edges of the surface between the same vertices");
    doubled.push_back(interior);
  };
  for (int h = 0; h < front_ - back_; ++h) {
    const int fill_edge = fill_.mates[h] >= 0 ? std::max(h, fill_.mates[h]) : -1;
    examine(onBack(h), fill_edge);
    examine(onFront(h), fill_edge);
  }
  std::vector<bool> on_wall(result_.vertices.size(), false);
  for (std::size_t t = static_cast<std::size_t>(back_) / 3; t < result_.triangles.size(); ++t) {
    for (const int v : result_.triangles[t]) on_wall[v] = true;
  }
  for (int h = 0; h < back_; ++h) {
    if (!surface_.used(h / 3)) continue;
    if (on_wall[startOf(result_.triangles, h)] && on_wall[endOf(result_.triangles, h)]) examine(h, -1);
  }
  std::sort(doubled.begin(), doubled.end());
  doubled.erase(std::unique(doubled.begin(), doubled.end()), doubled.end());
  return doubled;
}

}  // namespace

StitchedSurface stitch(const SplitSurface& surface, WallFill fill) {
  for (int repair = 0; repair < kMaxRepairs; ++repair) {
    const Stitching stitching(surface, fill);
    const std::vector<int> doubled = stitching.doubledFillEdges();
    if (doubled.empty()) return stitching.result();
    for (const int h : doubled) splitFillEdge(h, &fill);
  }
  throw CutRefused("the cut would leave edges of its faces between the same vertices");
}

}  // namespace softbody
