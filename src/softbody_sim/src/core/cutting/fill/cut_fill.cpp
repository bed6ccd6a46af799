#include "cutting/fill/cut_fill.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "cutting/split/cut_refused.h"
#include "plane/constrained_triangulation.h"

namespace softbody {
namespace {

using DirectedEdge = std::array<int, 2>;

class Filling {
 public:
  Filling(const SplitSurface& surface, const CutCurve& curve, const PatchFacets& facets, double snap_distance)
      : surface_(surface), curve_(curve), facets_(facets), snap_distance_(snap_distance) {}

  CutFill run();

 private:
  struct Facet {
    std::vector<DirectedEdge> constraints;
    TriangleList triangles;
    std::vector<int> regions;  ///< per triangle, over all facets
  };

  int pointAt(const Eigen::Vector3d& position);
  int patchPoint(int patch_vertex);
  void addCurve();
  void addFolds();
  void triangulate(int facet);
  template <class Visit>
  void forEachEdge(const Visit& visit) const;
  std::vector<bool> findInside() const;
  void collect(const std::vector<bool>& inside);

  const SplitSurface& surface_;
  const CutCurve& curve_;
  const PatchFacets& facets_;
  double snap_distance_;
  CutFill fill_;
  std::map<std::tuple<double, double, double>, int> point_numbers_;
  std::map<DirectedEdge, int> curve_edges_;  ///< -> half-edge of the surface
  std::map<DirectedEdge, int>
      borders_;  ///< edges where facets meet or the patch ends -> the facet on the left
  std::vector<Facet> parts_;
  int curve_point_count_ = 0;  ///< the points of the curve come first
  int region_count_ = 0;
};

CutFill Filling::run() {
  parts_.resize(facets_.frames.size());
  addCurve();
  addFolds();
  for (std::size_t f = 0; f < parts_.size(); ++f) triangulate(static_cast<int>(f));
  collect(findInside());
  return std::move(fill_);
}

/// Vertices at the same place, on the two walls of an earlier cut, become one point.
int Filling::pointAt(const Eigen::Vector3d& p) {
  const auto [entry, is_new] =
      point_numbers_.emplace(std::make_tuple(p.x(), p.y(), p.z()), static_cast<int>(fill_.points.size()));
  if (is_new) fill_.points.push_back(p);
  return entry->second;
}

int Filling::patchPoint(int patch_vertex) {
  const Eigen::Vector3d position = facets_.patch.vertices.row(patch_vertex);
  int nearest = -1;
  double distance = snap_distance_;
  for (int p = 0; p < curve_point_count_; ++p) {
    if ((fill_.points[p] - position).norm() >= distance) continue;
    distance = (fill_.points[p] - position).norm();
    nearest = p;
  }
  return nearest >= 0 ? nearest : pointAt(position);
}

void Filling::addCurve() {
  for (const int h : halfEdgesOfCurve(surface_)) {
    const DirectedEdge edge{pointAt(surface_.vertices[startOf(surface_.triangles, h)]),
                            pointAt(surface_.vertices[endOf(surface_.triangles, h)])};
    if (!curve_edges_.emplace(edge, h).second)
      throw CutRefused("the cut meets the surface twice at one place");
    parts_[surface_.curve[h]].constraints.push_back(edge);
  }
  curve_point_count_ = static_cast<int>(fill_.points.size());
}

/// Every edge at which facets meet or end, in parts between the points where it pierces the surface.
void Filling::addFolds() {
  std::map<int, std::vector<int>> piercings;  // patch edge -> nodes
  for (int node = 0; node < static_cast<int>(curve_.nodes.size()); ++node) {
    if (curve_.nodes[node].patch_edge >= 0) piercings[curve_.nodes[node].patch_edge].push_back(node);
  }
  for (int e = 0; e < static_cast<int>(facets_.edges.size()); ++e) {
    const PatchEdge& edge = facets_.edges[e];
    if (!edge.fold) continue;
    std::vector<int>& nodes = piercings[e];
    std::sort(nodes.begin(), nodes.end(),
              [this](int a, int b) { return curve_.nodes[a].along < curve_.nodes[b].along; });
    std::vector<int> chain{patchPoint(edge.first)};
    for (const int node : nodes) chain.push_back(pointAt(surface_.vertices[surface_.node_vertices[node]]));
    chain.push_back(patchPoint(edge.second));
    for (std::size_t k = 0; k + 1 < chain.size(); ++k) {
      if (chain[k] == chain[k + 1]) continue;
      const DirectedEdge piece{chain[k], chain[k + 1]}, reverse{chain[k + 1], chain[k]};
      borders_[piece] = facets_.facets[edge.left];
      parts_[facets_.facets[edge.left]].constraints.push_back(piece);
      if (edge.right < 0) continue;
      borders_[reverse] = facets_.facets[edge.right];
      parts_[facets_.facets[edge.right]].constraints.push_back(reverse);
    }
  }
}

void Filling::triangulate(int facet) {
  Facet& part = parts_[facet];
  std::vector<int> numbers;
  for (const DirectedEdge& edge : part.constraints) numbers.insert(numbers.end(), edge.begin(), edge.end());
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  std::vector<Eigen::Vector2d> points;
  points.reserve(numbers.size());
  for (const int p : numbers) points.push_back(facets_.frames[facet].project(fill_.points[p]));
  std::vector<DirectedEdge> constraints;
  for (const DirectedEdge& edge : part.constraints) {
    const auto local = [&numbers](int p) {
      return static_cast<int>(std::lower_bound(numbers.begin(), numbers.end(), p) - numbers.begin());
    };
    constraints.push_back({local(edge[0]), local(edge[1])});
  }
  const auto plane = triangulatePlane(points, constraints);
  if (!plane) throw CutRefused("the edges of the cut's faces cross each other");
  int last = -1;
  for (std::size_t t = 0; t < plane->triangles.size(); ++t) {
    part.triangles.push_back(
        {numbers[plane->triangles[t][0]], numbers[plane->triangles[t][1]], numbers[plane->triangles[t][2]]});
    part.regions.push_back(region_count_ + plane->regions[t]);
    last = std::max(last, plane->regions[t]);
  }
  region_count_ += last + 1;
}

template <class Visit>
void Filling::forEachEdge(const Visit& visit) const {
  for (std::size_t f = 0; f < parts_.size(); ++f) {
    const Facet& part = parts_[f];
    for (int h = 0; h < 3 * static_cast<int>(part.triangles.size()); ++h) {
      visit(DirectedEdge{startOf(part.triangles, h), endOf(part.triangles, h)}, static_cast<int>(f),
            part.regions[h / 3]);
    }
  }
}

/// Regions to the left of the curve are inside of the body, and so are their neighbours across folds.
std::vector<bool> Filling::findInside() const {
  std::map<DirectedEdge, int> border_regions;
  std::vector<bool> inside(static_cast<std::size_t>(region_count_), false);
  forEachEdge([&](const DirectedEdge& edge, int facet, int region) {
    const auto border = borders_.find(edge);
    if (border != borders_.end() && border->second == facet) border_regions[edge] = region;
    if (curve_edges_.count(edge) > 0) inside[region] = true;
  });
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& [edge, region] : border_regions) {
      const DirectedEdge reverse{edge[1], edge[0]};
      const auto other = border_regions.find(reverse);
      if (other == border_regions.end() || !inside[region] || inside[other->second]) continue;
      if (curve_edges_.count(edge) > 0 || curve_edges_.count(reverse) > 0) continue;
      inside[other->second] = changed = true;
    }
  }
  forEachEdge([&](const DirectedEdge& edge, int facet, int region) {
    const DirectedEdge reverse{edge[1], edge[0]};
    const auto border = borders_.find(reverse);
    const bool beyond_border = border != borders_.end() && border->second == facet;
    if (inside[region] && curve_edges_.count(edge) == 0 &&
        (curve_edges_.count(reverse) > 0 || beyond_border)) {
      throw CutRefused("the cut's curve does not bound its faces");
    }
  });
  return inside;
}

void Filling::collect(const std::vector<bool>& inside) {
  for (std::size_t f = 0; f < parts_.size(); ++f) {
    for (std::size_t t = 0; t < parts_[f].triangles.size(); ++t) {
      if (!inside[parts_[f].regions[t]]) continue;
      fill_.triangles.push_back(parts_[f].triangles[t]);
      fill_.facets.push_back(static_cast<int>(f));
    }
  }
  const int count = 3 * static_cast<int>(fill_.triangles.size());
  std::map<DirectedEdge, int> half_edges;
  for (int h = 0; h < count; ++h) {
    if (!half_edges.emplace(DirectedEdge{startOf(fill_.triangles, h), endOf(fill_.triangles, h)}, h).second) {
      throw CutRefused("the cut's faces overlap");
    }
  }
  fill_.curve.assign(count, -1);
  fill_.mates.assign(count, -1);
  std::size_t bounded = 0;
  for (const auto& [edge, h] : half_edges) {
    const auto on_curve = curve_edges_.find(edge);
    const auto neighbour = half_edges.find({edge[1], edge[0]});
    if (on_curve != curve_edges_.end()) {
      fill_.curve[h] = on_curve->second;
      ++bounded;
    } else if (neighbour != half_edges.end() && curve_edges_.count(neighbour->first) == 0) {
      fill_.mates[h] = neighbour->second;
    }
  }
  if (bounded != curve_edges_.size()) throw CutRefused("the cut's faces do not reach its whole curve");
}

}  // namespace

CutFill fillWalls(const SplitSurface& surface, const CutCurve& curve, const PatchFacets& facets,
                  double snap_distance) {
  return Filling(surface, curve, facets, snap_distance).run();
}

}  // namespace softbody
