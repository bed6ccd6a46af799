#include "identification/tet_refinement.h"

#include <algorithm>
#include <map>
#include <utility>

#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_common/geometry/tet_locator.h"

namespace softbody {
namespace {

/// The vertices of a mesh with the middles of its edges.
class Middles {
 public:
  explicit Middles(const Points& vertices) : count_(static_cast<int>(vertices.rows())) {}

  int of(int a, int b) {
    const std::pair<int, int> edge = std::minmax(a, b);
    const auto [place, is_new] = index_.emplace(edge, count_ + static_cast<int>(ends_.size()));
    if (is_new) ends_.emplace_back(edge.first, edge.second);
    return place->second;
  }
  const std::vector<Eigen::Vector2i>& ends() const { return ends_; }

 private:
  int count_;
  std::map<std::pair<int, int>, int> index_;
  std::vector<Eigen::Vector2i> ends_;
};

Points withMiddles(const Points& vertices, const std::vector<Eigen::Vector2i>& ends) {
  Points all(vertices.rows() + static_cast<Eigen::Index>(ends.size()), 3);
  all.topRows(vertices.rows()) = vertices;
  for (std::size_t k = 0; k < ends.size(); ++k)
    all.row(vertices.rows() + static_cast<Eigen::Index>(k)) =
        0.5 * (vertices.row(ends[k].x()) + vertices.row(ends[k].y()));
  return all;
}

using TetList = std::vector<Eigen::Vector4i>;

/// The octahedron between the middles: around its shortest diagonal, which joins the middles of two opposite
/// edges, stand the other four in a ring.
void addOctahedron(const Eigen::RowVector4i& tet, const Points& vertices, Middles* middles, TetList* tets) {
  constexpr int kEdges[3][4] = {{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2}};  // of each diagonal, opposite
  double shortest = std::numeric_limits<double>::max();
  int chosen = 0;
  for (int k = 0; k < 3; ++k) {
    const int* e = kEdges[k];
    const double length = (vertices.row(tet[e[0]]) + vertices.row(tet[e[1]]) - vertices.row(tet[e[2]]) -
                           vertices.row(tet[e[3]]))
                              .norm();
    if (length < shortest) shortest = length, chosen = k;
  }
  const auto [a, b, c, d] = std::make_tuple(tet[kEdges[chosen][0]], tet[kEdges[chosen][1]],
                                            tet[kEdges[chosen][2]], tet[kEdges[chosen][3]]);
  const int from = middles->of(a, b), to = middles->of(c, d);
  const int ring[4] = {middles->of(a, c), middles->of(a, d), middles->of(b, d), middles->of(b, c)};
  for (int k = 0; k < 4; ++k) tets->push_back({from, to, ring[k], ring[(k + 1) % 4]});
}

Tets orientedTets(const TetList& list, const Points& vertices) {
  Tets tets(static_cast<Eigen::Index>(list.size()), 4);
  for (Eigen::Index t = 0; t < tets.rows(); ++t) tets.row(t) = list[static_cast<std::size_t>(t)].transpose();
  const Eigen::VectorXd volumes = tetVolumes(vertices, tets);
  for (Eigen::Index t = 0; t < tets.rows(); ++t)
    if (volumes[t] < 0.0) std::swap(tets(t, 2), tets(t, 3));
  return tets;
}

std::vector<Pin> refinedPins(const std::vector<Pin>& pins, const RefinedTets& refined, Eigen::Index before) {
  std::map<int, Pin> by_vertex;
  for (const Pin& pin : pins) by_vertex[pin.vertex] = pin;
  std::vector<Pin> all = pins;
  for (std::size_t k = 0; k < refined.ends.size(); ++k) {
    const auto a = by_vertex.find(refined.ends[k].x()), b = by_vertex.find(refined.ends[k].y());
    if (a == by_vertex.end() || b == by_vertex.end()) continue;
    all.push_back({static_cast<int>(before) + static_cast<int>(k),
                   0.5 * (a->second.position + b->second.position),
                   std::max(a->second.accuracy_m, b->second.accuracy_m)});
  }
  return all;
}

/// Vertices and the middles between two of them.
std::vector<int> refinedGroup(const std::vector<int>& group, const RefinedTets& refined,
                              Eigen::Index before) {
  std::vector<int> all = group;
  const auto has = [&group](int v) { return std::find(group.begin(), group.end(), v) != group.end(); };
  for (std::size_t k = 0; k < refined.ends.size(); ++k)
    if (has(refined.ends[k].x()) && has(refined.ends[k].y()))
      all.push_back(static_cast<int>(before) + static_cast<int>(k));
  return all;
}

/// A quarter of the load of a tet's corner belongs to it; loads are shared with the middles around, half and
/// half, so that their sum and their moment stay nearly the same.
Points refinedLoads(const Points& loads, const RefinedTets& refined, Eigen::Index before) {
  if (loads.size() == 0) return loads;
  Points all = Points::Zero(refined.topology.rest_vertices.rows(), 3);
  Eigen::VectorXd neighbours = Eigen::VectorXd::Zero(before);
  const auto loaded = [&loads](int v) { return !loads.row(v).isZero(0.0); };
  const auto is_shared = [&](const Eigen::Vector2i& ends) { return loaded(ends.x()) && loaded(ends.y()); };
  for (const Eigen::Vector2i& ends : refined.ends)
    if (is_shared(ends)) neighbours[ends.x()] += 1.0, neighbours[ends.y()] += 1.0;
  for (Eigen::Index v = 0; v < before; ++v) all.row(v) = loads.row(v) * (neighbours[v] > 0.0 ? 0.5 : 1.0);
  for (std::size_t k = 0; k < refined.ends.size(); ++k) {
    if (!is_shared(refined.ends[k])) continue;
    for (const int v : {refined.ends[k].x(), refined.ends[k].y()})
      all.row(before + static_cast<Eigen::Index>(k)) += 0.5 * loads.row(v) / neighbours[v];
  }
  return all;
}

}  // namespace

RefinedTets refine(const TetTopology& topology) {
  Middles middles(topology.rest_vertices);
  TetList list;
  for (Eigen::Index t = 0; t < topology.tets.rows(); ++t) {
    const Eigen::RowVector4i tet = topology.tets.row(t);
    for (int k = 0; k < 4; ++k) {
      Eigen::Vector4i corner;
      for (int j = 0; j < 4; ++j) corner[j] = j == k ? tet[k] : middles.of(tet[k], tet[j]);
      list.push_back(corner);
    }
    addOctahedron(tet, topology.rest_vertices, &middles, &list);
  }
  RefinedTets refined{topology, middles.ends()};
  TetTopology& fine = refined.topology;
  fine.rest_vertices = withMiddles(topology.rest_vertices, refined.ends);
  fine.tets = orientedTets(list, fine.rest_vertices);
  fine.surface = boundaryTriangles(fine.tets);
  const int count = static_cast<int>(fine.rest_vertices.rows());
  fine.vertex_parents.resize(static_cast<std::size_t>(count));
  for (int v = 0; v < count; ++v) fine.vertex_parents[static_cast<std::size_t>(v)] = v;
  fine.tet_pieces = tetPieces(fine.tets, count);
  return refined;
}

MaterialProblem refine(const MaterialProblem& problem) {
  const Eigen::Index before = problem.topology.rest_vertices.rows();
  const RefinedTets refined = refine(problem.topology);
  const TetLocator locator(refined.topology.rest_vertices, refined.topology.tets);
  MaterialProblem fine = problem;
  fine.topology = refined.topology;
  for (ShapeObservation& observation : fine.observations) {
    for (Target& target : observation.targets)
      target.place =
          locator.locate(positionOf(target.place, problem.topology.rest_vertices, problem.topology.tets));
    observation.surroundings.pins = refinedPins(observation.surroundings.pins, refined, before);
    observation.surroundings.loads = refinedLoads(observation.surroundings.loads, refined, before);
    for (MeasuredWrench& wrench : observation.wrenches)
      wrench.vertices = refinedGroup(wrench.vertices, refined, before);
  }
  return fine;
}

}  // namespace softbody
