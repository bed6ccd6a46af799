#include "core/cutting/split_surface.h"

#include <algorithm>
#include <map>
#include <set>

#include "core/cutting/cut_refused.h"
#include "core/cutting/planar_triangulation.h"

namespace softbody {
namespace {

/// The curve, sorted by where it meets the mesh.
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

/// One triangle with the curve's pieces in it.
struct DividedTriangle {
  std::vector<int> vertices;                    ///< of the surface: the border's in order, then inner ones
  std::vector<Eigen::Vector3d> weights;         ///< barycentric coordinates
  std::vector<Eigen::Vector2d> points;          ///< in the triangle's plane
  std::vector<std::array<int, 2>> constraints;  ///< the border first
  std::size_t border_size = 0;
};

class Splitter {
 public:
  Splitter(const CutCurve& curve, const std::vector<int>& mates, SplitSurface* surface)
      : curve_(curve), mates_(mates), places_(sortByPlace(curve)), surface_(*surface) {}

  void run() {
    for (const auto& [triangle, segments] : places_.segments) divide(triangle, segments);
  }

 private:
  void addBorder(int triangle, DividedTriangle* divided) const;
  void addSegments(const std::vector<int>& segments, DividedTriangle* divided) const;
  void project(int triangle, DividedTriangle* divided) const;
  void divide(int triangle, const std::vector<int>& segments);
  void append(int triangle, const DividedTriangle& divided, const TriangleList& parts);

  const CutCurve& curve_;
  const std::vector<int>& mates_;
  CurveByPlace places_;
  SplitSurface& surface_;
};

void Splitter::addBorder(int triangle, DividedTriangle* divided) const {
  for (int k = 0; k < 3; ++k) {
    const int h = 3 * triangle + k, edge = std::min(h, mates_[h]);
    const Eigen::Vector3d start = Eigen::Vector3d::Unit(k), end = Eigen::Vector3d::Unit((k + 1) % 3);
    divided->vertices.push_back(surface_.triangles[triangle][k]);
    divided->weights.push_back(start);
    const auto found = places_.nodes.find(edge);
    if (found == places_.nodes.end()) continue;
    std::vector<int> nodes = found->second;
    if (edge != h) std::reverse(nodes.begin(), nodes.end());
    for (const int node : nodes) {
      const double along = edge == h ? curve_.nodes[node].along : 1.0 - curve_.nodes[node].along;
      divided->vertices.push_back(surface_.node_vertices[node]);
      divided->weights.push_back((1.0 - along) * start + along * end);
    }
  }
  divided->border_size = divided->vertices.size();
  const int size = static_cast<int>(divided->border_size);
  for (int k = 0; k < size; ++k) divided->constraints.push_back({k, (k + 1) % size});
}

void Splitter::addSegments(const std::vector<int>& segments, DividedTriangle* divided) const {
  const auto indexOf = [this, divided](int node) {
    const int vertex = surface_.node_vertices[node];
    const auto found = std::find(divided->vertices.begin(), divided->vertices.end(), vertex);
    if (found == divided->vertices.end()) {
      divided->vertices.push_back(vertex);
      return static_cast<int>(divided->vertices.size()) - 1;
    }
    return static_cast<int>(found - divided->vertices.begin());
  };
  for (const int s : segments) {
    divided->constraints.push_back({indexOf(curve_.segments[s].from), indexOf(curve_.segments[s].to)});
  }
}

void Splitter::project(int triangle, DividedTriangle* divided) const {
  const auto& [a, b, c] = surface_.triangles[triangle];
  const Eigen::Vector3d origin = surface_.vertices[a];
  const Eigen::Vector3d ab = surface_.vertices[b] - origin, ac = surface_.vertices[c] - origin;
  const Eigen::Vector3d normal = ab.cross(ac);
  const PlaneFrame frame{origin, ab.normalized(), normal.cross(ab).normalized()};
  for (std::size_t k = 0; k < divided->vertices.size(); ++k) {
    const Eigen::Vector3d place = surface_.vertices[divided->vertices[k]] - origin;
    divided->points.push_back(frame.project(origin + place));
    if (k < divided->border_size) continue;
    const double wb = place.cross(ac).dot(normal) / normal.squaredNorm();
    const double wc = ab.cross(place).dot(normal) / normal.squaredNorm();
    divided->weights.emplace_back(1.0 - wb - wc, wb, wc);
  }
}

void Splitter::divide(int triangle, const std::vector<int>& segments) {
  DividedTriangle divided;
  addBorder(triangle, &divided);
  addSegments(segments, &divided);
  project(triangle, &divided);
  const auto plane = triangulatePlane(divided.points, divided.constraints);
  if (!plane) throw CutRefused("the cut crosses itself on the surface");

  // The regions at the border and at the curve; what is left of the convex hull are gaps of rounding.
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
    if (regions.count(plane->regions[t]) > 0) parts.push_back(plane->triangles[t]);
  }
  std::map<std::array<int, 2>, int> facets;
  for (std::size_t k = 0; k < segments.size(); ++k) {
    facets[divided.constraints[divided.border_size + k]] = curve_.segments[segments[k]].facet;
  }
  const std::size_t first_new = surface_.triangles.size();
  append(triangle, divided, parts);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const std::size_t place = p == 0 ? static_cast<std::size_t>(triangle) : first_new + p - 1;
    for (int k = 0; k < 3; ++k) {
      const auto found = facets.find({parts[p][k], parts[p][(k + 1) % 3]});
      if (found != facets.end()) surface_.curve[3 * place + k] = found->second;
    }
  }
}

/// The first part takes the triangle's place, the others follow at the end.
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
      if (has_texture) surface_.texture[3 * place + k] = texture * divided.weights[parts[p][k]];
    }
  }
}

}  // namespace

SplitSurface splitAlong(const CutCurve& curve, const MeshTopology& mesh, TriangleList triangles,
                        const std::vector<int>& mates) {
  SplitSurface surface;
  surface.own_vertices = static_cast<int>(mesh.rest_vertices.rows());
  for (Eigen::Index v = 0; v < mesh.rest_vertices.rows(); ++v)
    surface.vertices.push_back(mesh.rest_vertices.row(v));
  for (const CurveNode& node : curve.nodes) {
    surface.node_vertices.push_back(static_cast<int>(surface.vertices.size()));
    surface.vertices.push_back(node.position);
  }
  surface.triangles = std::move(triangles);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) surface.sources.push_back(static_cast<int>(t));
  for (Eigen::Index c = 0; c < mesh.texture_coordinates.rows(); ++c) {
    surface.texture.push_back(mesh.texture_coordinates.row(c).head<2>());
  }
  surface.curve.assign(3 * surface.triangles.size(), -1);
  Splitter(curve, mates, &surface).run();
  surface.mates = halfEdgeMates(surface.triangles, static_cast<int>(surface.vertices.size()));
  return surface;
}

}  // namespace softbody
