#include "cutting/split/split_surface.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "cutting/split/cut_refused.h"
#include "plane/constrained_triangulation.h"

namespace softbody {
namespace {

/// The curve, sorted by edges and triangles of the mesh.
struct CurveByPlace {
  std::map<int, std::vector<int>> nodes;     ///< mesh edge -> nodes in ascending order
  std::map<int, std::vector<int>> segments;  ///< triangle -> segments
};

CurveByPlace sortByPlace(const CutCurve& curve) {
  CurveByPlace places;
  for (std::size_t s = 0; s < curve.segments.size(); ++s) {
    const CurveSegment& segment = curve.segments[s];
    places.segments[segment.triangle].push_back(static_cast<int>(s));
    for (const int node : {segment.from, segment.to}) {
      if (curve.nodes[node].mesh_edge >= 0) places.nodes[curve.nodes[node].mesh_edge].push_back(node);
    }
  }
  for (auto& [edge, nodes] : places.nodes) {
    std::sort(nodes.begin(), nodes.end(), [&curve](int a, int b) {
      return std::pair(curve.nodes[a].along, a) < std::pair(curve.nodes[b].along, b);
    });
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  }
  return places;
}

/// One triangle with the segments of the curve in it. The order depends on positions only: the two walls of
/// an earlier cut are mirror images, are divided alike and stay mirror images.
struct DividedTriangle {
  std::array<int, 3> corners;                   ///< of the triangle, 0..2, in the order of their positions
  bool reversed = false;                        ///< this order is clockwise
  std::vector<int> vertices;                    ///< of the surface: on the border in order, then inner ones
  std::vector<Eigen::Vector3d> weights;         ///< barycentric coordinates
  std::vector<Eigen::Vector2d> points;          ///< in the triangle's plane
  std::vector<std::array<int, 2>> constraints;  ///< the border first
  std::size_t border_size = 0;
  std::map<std::array<int, 2>, int> facets;  ///< per directed segment of the curve
};

class Splitter {
 public:
  Splitter(const CutCurve& curve, const std::vector<int>& mates, SplitSurface* surface)
      : curve_(curve), mates_(mates), places_(sortByPlace(curve)), surface_(*surface) {}

  void run() {
    for (const auto& [triangle, segments] : places_.segments) divide(triangle, segments);
  }

 private:
  void orderCorners(int triangle, DividedTriangle* divided) const;
  void addBorder(int triangle, DividedTriangle* divided) const;
  void addSegments(const std::vector<int>& segments, DividedTriangle* divided) const;
  void project(int triangle, DividedTriangle* divided) const;
  TriangleList partsOf(const DividedTriangle& divided) const;
  void divide(int triangle, const std::vector<int>& segments);
  void append(int triangle, const DividedTriangle& divided, const TriangleList& parts);

  bool precedes(int vertex, int other) const {
    const Eigen::Vector3d &a = surface_.vertices[vertex], &b = surface_.vertices[other];
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  }

  const CutCurve& curve_;
  const std::vector<int>& mates_;
  CurveByPlace places_;
  SplitSurface& surface_;
};

void Splitter::orderCorners(int triangle, DividedTriangle* divided) const {
  const auto& vertices = surface_.triangles[triangle];
  std::array<int, 3>& corners = divided->corners = {0, 1, 2};
  std::sort(corners.begin(), corners.end(), [&](int a, int b) { return precedes(vertices[a], vertices[b]); });
  divided->reversed = (corners[0] + 1) % 3 != corners[1];
}

void Splitter::addBorder(int triangle, DividedTriangle* divided) const {
  for (int k = 0; k < 3; ++k) {
    const int first = divided->corners[k], second = divided->corners[(k + 1) % 3];
    const int h = 3 * triangle + (divided->reversed ? second : first), edge = std::min(h, mates_[h]);
    const bool forward = (edge == h) != divided->reversed;
    divided->vertices.push_back(surface_.triangles[triangle][first]);
    divided->weights.push_back(Eigen::Vector3d::Unit(first));
    const auto found = places_.nodes.find(edge);
    if (found == places_.nodes.end()) continue;
    std::vector<int> nodes = found->second;
    if (!forward) std::reverse(nodes.begin(), nodes.end());
    for (const int node : nodes) {
      const double along = forward ? curve_.nodes[node].along : 1.0 - curve_.nodes[node].along;
      divided->vertices.push_back(surface_.node_vertices[node]);
      divided->weights.push_back((1.0 - along) * Eigen::Vector3d::Unit(first) +
                                 along * Eigen::Vector3d::Unit(second));
    }
  }
  divided->border_size = divided->vertices.size();
  const int size = static_cast<int>(divided->border_size);
  for (int k = 0; k < size; ++k) divided->constraints.push_back({k, (k + 1) % size});
}

void Splitter::addSegments(const std::vector<int>& segments, DividedTriangle* divided) const {
  std::vector<int> inner;  // where edges of the patch pierce the triangle
  for (const int s : segments) {
    for (const int node : {curve_.segments[s].from, curve_.segments[s].to}) {
      if (curve_.nodes[node].mesh_edge < 0) inner.push_back(surface_.node_vertices[node]);
    }
  }
  std::sort(inner.begin(), inner.end(), [this](int a, int b) { return precedes(a, b); });
  inner.erase(std::unique(inner.begin(), inner.end()), inner.end());
  divided->vertices.insert(divided->vertices.end(), inner.begin(), inner.end());
  const auto indexOf = [this, divided](int node) {
    const auto& all = divided->vertices;
    return static_cast<int>(std::find(all.begin(), all.end(), surface_.node_vertices[node]) - all.begin());
  };
  for (const int s : segments) {
    const int from = indexOf(curve_.segments[s].from), to = indexOf(curve_.segments[s].to);
    divided->facets[{from, to}] = curve_.segments[s].facet;
    divided->constraints.push_back({std::min(from, to), std::max(from, to)});
  }
  std::sort(divided->constraints.begin() + static_cast<std::ptrdiff_t>(divided->border_size),
            divided->constraints.end());
}

void Splitter::project(int triangle, DividedTriangle* divided) const {
  const auto& vertices = surface_.triangles[triangle];
  const auto& [a, b, c] = divided->corners;
  const Eigen::Vector3d origin = surface_.vertices[vertices[a]];
  const Eigen::Vector3d ab = surface_.vertices[vertices[b]] - origin,
                        ac = surface_.vertices[vertices[c]] - origin;
  const Eigen::Vector3d normal = ab.cross(ac);
  const PlaneFrame frame{origin, ab.normalized(), normal.cross(ab).normalized()};
  for (std::size_t k = 0; k < divided->vertices.size(); ++k) {
    const Eigen::Vector3d& position = surface_.vertices[divided->vertices[k]];
    divided->points.push_back(frame.project(position));
    if (k < divided->border_size) continue;
    const Eigen::Vector3d place = position - origin;
    const double wb = place.cross(ac).dot(normal) / normal.squaredNorm();
    const double wc = ab.cross(place).dot(normal) / normal.squaredNorm();
    Eigen::Vector3d weights;
    weights[a] = 1.0 - wb - wc, weights[b] = wb, weights[c] = wc;
    divided->weights.push_back(weights);
  }
}

/// The triangles of the regions at the border and at the curve. Other regions of the convex hull are rounding
/// gaps.
TriangleList Splitter::partsOf(const DividedTriangle& divided) const {
  const auto plane = triangulatePlane(divided.points, divided.constraints);
  if (!plane) throw CutRefused("the cut crosses itself on the surface");
  std::set<std::array<int, 2>> inward;
  for (std::size_t k = 0; k < divided.constraints.size(); ++k) {
    const auto& [start, end] = divided.constraints[k];
    inward.insert({start, end});
    if (k >= divided.border_size) inward.insert({end, start});
  }
  std::set<int> regions;
  for (int h = 0; h < 3 * static_cast<int>(plane->triangles.size()); ++h) {
    if (inward.count({startOf(plane->triangles, h), endOf(plane->triangles, h)}) > 0) {
      regions.insert(plane->regions[h / 3]);
    }
  }
  TriangleList parts;
  for (std::size_t t = 0; t < plane->triangles.size(); ++t) {
    if (regions.count(plane->regions[t]) == 0) continue;
    parts.push_back(plane->triangles[t]);
    if (divided.reversed) std::swap(parts.back()[1], parts.back()[2]);
  }
  return parts;
}

void Splitter::divide(int triangle, const std::vector<int>& segments) {
  DividedTriangle divided;
  orderCorners(triangle, &divided);
  addBorder(triangle, &divided);
  addSegments(segments, &divided);
  project(triangle, &divided);
  append(triangle, divided, partsOf(divided));
}

/// The first part replaces the triangle, the others are appended.
void Splitter::append(int triangle, const DividedTriangle& divided, const TriangleList& parts) {
  const bool has_texture = !surface_.texture.empty();
  Eigen::Matrix<double, 2, 3> texture;
  for (int k = 0; k < 3 && has_texture; ++k) texture.col(k) = surface_.texture[3 * triangle + k];
  for (std::size_t p = 0; p < parts.size(); ++p) {
    if (p > 0) {
      surface_.triangles.emplace_back();
      surface_.sources.push_back(surface_.sources[triangle]);
      surface_.curve.insert(surface_.curve.end(), 3, -1);
      if (has_texture) surface_.texture.resize(surface_.texture.size() + 3);
    }
    const std::size_t place = p == 0 ? static_cast<std::size_t>(triangle) : surface_.triangles.size() - 1;
    surface_.changed.push_back(static_cast<int>(place));
    for (int k = 0; k < 3; ++k) {
      surface_.triangles[place][k] = divided.vertices[parts[p][k]];
      const auto facet = divided.facets.find({parts[p][k], parts[p][(k + 1) % 3]});
      surface_.curve[3 * place + static_cast<std::size_t>(k)] =
          facet == divided.facets.end() ? -1 : facet->second;
      if (has_texture) surface_.texture[3 * place + k] = texture * divided.weights[parts[p][k]];
    }
  }
}

/// Pairs the half-edges of changed triangles with each other and with the neighbours of the replaced
/// triangles.
void pairChangedTriangles(const std::vector<int>& mates, SplitSurface* surface) {
  std::vector<bool> changed(surface->triangles.size(), false);
  for (const int t : surface->changed) changed[static_cast<std::size_t>(t)] = true;
  std::vector<int> loose;
  for (const int t : surface->changed) {
    for (int h = 3 * t; h < 3 * t + 3; ++h) {
      loose.push_back(h);
      if (h < static_cast<int>(mates.size()) && !changed[static_cast<std::size_t>(mates[h]) / 3])
        loose.push_back(mates[h]);
    }
  }
  surface->mates = mates;
  surface->mates.resize(3 * surface->triangles.size(), -1);
  pairHalfEdges(surface->triangles, loose, &surface->mates);
}

}  // namespace

std::vector<int> halfEdgesOfCurve(const SplitSurface& surface) {
  std::vector<int> half_edges;
  for (int h = 0; h < static_cast<int>(surface.curve.size()); ++h) {
    if (surface.curve[h] >= 0 && surface.used(h / 3)) half_edges.push_back(h);
  }
  return half_edges;
}

bool sameTexture(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  constexpr double kSame = 1e-6;  // well above rounding
  return (a - b).cwiseAbs().maxCoeff() < kSame;
}

SplitSurface splitAlong(const CutCurve& curve, const MeshTopology& mesh, TriangleList triangles,
                        const std::vector<int>& mates) {
  SplitSurface surface;
  surface.own_vertices = static_cast<int>(mesh.rest_vertices.rows());
  surface.vertices.reserve(static_cast<std::size_t>(surface.own_vertices) + curve.nodes.size());
  for (int v = 0; v < surface.own_vertices; ++v) surface.vertices.push_back(mesh.rest_vertices.row(v));
  for (const CurveNode& node : curve.nodes) {
    surface.node_vertices.push_back(static_cast<int>(surface.vertices.size()));
    surface.vertices.push_back(node.position);
  }
  surface.triangles = std::move(triangles);
  surface.sources.resize(surface.triangles.size());
  std::iota(surface.sources.begin(), surface.sources.end(), 0);
  // A triangle with k segments of the curve has about 2 k + 1 parts.
  const std::size_t part_count = surface.triangles.size() + 3 * curve.segments.size();
  surface.triangles.reserve(part_count);
  surface.sources.reserve(part_count);
  surface.curve.reserve(3 * part_count);
  if (mesh.texture_coordinates.rows() > 0) surface.texture.reserve(3 * part_count);
  for (Eigen::Index c = 0; c < mesh.texture_coordinates.rows(); ++c) {
    surface.texture.push_back(mesh.texture_coordinates.row(c).head<2>());
  }
  surface.curve.assign(3 * surface.triangles.size(), -1);
  Splitter(curve, mates, &surface).run();
  pairChangedTriangles(mates, &surface);
  return surface;
}

}  // namespace softbody
