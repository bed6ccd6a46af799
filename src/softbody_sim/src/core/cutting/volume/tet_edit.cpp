#include "cutting/volume/tet_edit.h"

#include <Eigen/Dense>
#include <algorithm>

#include "softbody_common/geometry/tet_geometry.h"

namespace softbody {
namespace {

MaterialPoint placeOf(const EdgeCrossing& split, const Tets& tets) {
  MaterialPoint place{split.tet, Eigen::Vector4d::Zero()};
  for (int k = 0; k < 4; ++k) {
    if (tets(split.tet, k) == split.a) place.barycentric[k] = 1.0 - split.t;
    if (tets(split.tet, k) == split.b) place.barycentric[k] = split.t;
  }
  return place;
}

/// The steps of an edit: the earlier topology, its subdivision and its opening.
struct CutSteps {
  const TetTopology& before;
  const std::vector<bool>& cut_before;
  const CutSubdivision& subdivision;
  const ManifoldCrack& crack;
};

std::vector<MaterialPoint> vertexOrigins(const CutSteps& steps) {
  std::vector<MaterialPoint> origins = placesOfVertices(steps.before);
  for (const EdgeCrossing& split : steps.subdivision.splits)
    origins.push_back(placeOf(split, steps.before.tets));
  for (const int source : steps.crack.opened.copied_from)
    origins.push_back(origins[static_cast<std::size_t>(source)]);
  return origins;
}

/// The earlier vertices that span a surface triangle; ascending.
std::vector<int> spanBefore(const Eigen::RowVector3i& triangle, const CutSteps& steps) {
  const auto old_count = static_cast<int>(steps.before.rest_vertices.rows());
  const auto subdivided_count = static_cast<int>(steps.subdivision.vertices.rows());
  std::vector<int> span;
  for (int v : triangle) {
    if (v >= subdivided_count)
      v = steps.crack.opened.copied_from[static_cast<std::size_t>(v - subdivided_count)];
    if (v < old_count) {
      span.push_back(v);
    } else {
      const EdgeCrossing& split = steps.subdivision.splits[static_cast<std::size_t>(v - old_count)];
      span.insert(span.end(), {split.a, split.b});
    }
  }
  std::sort(span.begin(), span.end());
  span.erase(std::unique(span.begin(), span.end()), span.end());
  return span;
}

/// Per surface triangle, whether a cut made it: it is not a part of an earlier uncut triangle.
std::vector<bool> cutTriangles(const CutSteps& steps) {
  std::vector<std::vector<int>> uncut;
  for (std::size_t f = 0; f < steps.cut_before.size(); ++f) {
    if (steps.cut_before[f]) continue;
    const Eigen::RowVector3i triangle = steps.before.surface.row(static_cast<Eigen::Index>(f));
    uncut.emplace_back(triangle.data(), triangle.data() + 3);
    std::sort(uncut.back().begin(), uncut.back().end());
  }
  std::sort(uncut.begin(), uncut.end());
  std::vector<bool> cut;
  for (const auto& triangle : steps.crack.surface.rowwise()) {
    cut.push_back(!std::binary_search(uncut.begin(), uncut.end(), spanBefore(triangle, steps)));
  }
  return cut;
}

TetTopology topologyAfter(const CutSteps& steps) {
  const std::vector<int>& copied_from = steps.crack.opened.copied_from;
  TetTopology after = steps.before;
  ++after.revision;
  const Points& vertices = steps.subdivision.vertices;
  after.rest_vertices.resize(vertices.rows() + static_cast<Eigen::Index>(copied_from.size()), 3);
  after.rest_vertices << vertices, vertices(copied_from, Eigen::all);
  after.tets = steps.crack.opened.tets;
  after.surface = steps.crack.surface;
  after.vertex_parents.resize(static_cast<std::size_t>(vertices.rows()), -1);
  for (const int source : copied_from) {
    after.vertex_parents.push_back(after.vertex_parents[static_cast<std::size_t>(source)]);
  }
  after.tet_pieces = tetPieces(after.tets, static_cast<int>(after.rest_vertices.rows()));
  return after;
}

std::vector<std::vector<int>> successorsOf(const CutSteps& steps) {
  std::vector<std::vector<int>> successors(static_cast<std::size_t>(steps.before.tets.rows()));
  const std::vector<int>& parents = steps.subdivision.parts.parents;
  for (std::size_t part = 0; part < parents.size(); ++part) {
    successors[static_cast<std::size_t>(parents[part])].push_back(static_cast<int>(part));
  }
  return successors;
}

}  // namespace

std::vector<MaterialPoint> placesOfVertices(const TetTopology& topology) {
  std::vector<MaterialPoint> places(static_cast<std::size_t>(topology.rest_vertices.rows()));
  for (int t = 0; t < static_cast<int>(topology.tets.rows()); ++t) {
    for (int k = 0; k < 4; ++k) {
      MaterialPoint& place = places[static_cast<std::size_t>(topology.tets(t, k))];
      if (place.tet < 0) place = {t, Eigen::Vector4d::Unit(k)};
    }
  }
  return places;
}

MaterialPoint TetEdit::placeAfter(const MaterialPoint& place, const TetTopology& before) const {
  const Eigen::Vector3d position = positionOf(place, before.rest_vertices, before.tets);
  MaterialPoint best;
  for (const int tet : successors[static_cast<std::size_t>(place.tet)]) {
    const Eigen::Vector4d weights =
        barycentricCoordinates(position, topology.rest_vertices, topology.tets.row(tet));
    if (best.tet < 0 || weights.minCoeff() > best.barycentric.minCoeff()) best = {tet, weights};
  }
  return best;
}

TetEdit assembleEdit(const TetTopology& before, const std::vector<bool>& cut,
                     const CutSubdivision& subdivision, const ManifoldCrack& crack) {
  const CutSteps steps{before, cut, subdivision, crack};
  return {topologyAfter(steps), cutTriangles(steps), vertexOrigins(steps), successorsOf(steps)};
}

}  // namespace softbody
