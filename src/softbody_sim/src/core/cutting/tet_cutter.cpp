#include "core/cutting/tet_cutter.h"

#include <Eigen/Dense>
#include <algorithm>
#include <iterator>
#include <stdexcept>

#include "core/cutting/cut_faces.h"
#include "core/cutting/edge_crossings.h"
#include "core/cutting/manifold.h"
#include "softbody_common/tet_geometry.h"

namespace softbody {
namespace {

void requireUsable(const CutPatch& patch) {
  if (!patch.vertices.allFinite()) throw std::invalid_argument("the cut's patch is not finite");
  const auto count = patch.vertices.rows();
  if (patch.triangles.size() > 0 && (patch.triangles.minCoeff() < 0 || patch.triangles.maxCoeff() >= count))
    throw std::invalid_argument("the cut's patch names a vertex that it does not have");
}

/// Both patches, the second behind the first.
CutPatch joined(const CutPatch& first, const CutPatch& second) {
  CutPatch both;
  both.vertices.resize(first.vertices.rows() + second.vertices.rows(), 3);
  both.vertices << first.vertices, second.vertices;
  both.triangles.resize(first.triangles.rows() + second.triangles.rows(), 3);
  both.triangles << first.triangles, second.triangles.array() + static_cast<int>(first.vertices.rows());
  return both;
}

MaterialPoint placeOf(const EdgeCrossing& split, const Tets& tets) {
  MaterialPoint place{split.tet, Eigen::Vector4d::Zero()};
  for (int k = 0; k < 4; ++k) {
    if (tets(split.tet, k) == split.a) place.barycentric[k] = 1.0 - split.t;
    if (tets(split.tet, k) == split.b) place.barycentric[k] = split.t;
  }
  return place;
}

struct Question {
  const Points& vertices;
  const TetTopology& topology;
  const std::vector<EdgeCrossing>& crossings;
  const SubdivisionSettings& settings;
};

struct Attempt {
  CutSubdivision subdivision;
  ManifoldCrack crack;
};

Attempt attemptCut(const Question& question, const CutStroke& stroke, const PatchIntersector& patch,
                   const std::vector<int>& known, const std::vector<bool>& spared) {
  Attempt attempt;
  const Tets& tets = question.topology.tets;
  attempt.subdivision =
      subdivide(question.vertices, tets, question.crossings, question.settings, stroke.on_cut, spared);
  const CutSubdivision& s = attempt.subdivision;
  const std::vector<Face> along = facesAlong(patch, s.vertices, s.parts.tets, s.on_cut);
  std::vector<Face> faces;
  std::set_union(along.begin(), along.end(), stroke.closed_faces.begin(), stroke.closed_faces.end(),
                 std::back_inserter(faces));
  attempt.crack = openManifoldCrack(s.parts.tets, static_cast<int>(s.vertices.rows()), faces, known);
  return attempt;
}

/// Cuts; where a vertex that was taken for one of the cut pinches the surface, again without taking it.
Attempt cutWithoutPinches(const Question& question, const CutStroke& stroke) {
  constexpr int kAttempts = 4;
  const PatchIntersector patch(stroke.patch);
  const std::vector<int> known = nonManifoldVertices(question.topology.surface);
  std::vector<bool> spared(stroke.on_cut.size(), false);
  Attempt attempt = attemptCut(question, stroke, patch, known, spared);
  for (int k = 1; k < kAttempts; ++k) {
    bool any = false;
    for (const int vertex : attempt.crack.pinches) {
      const auto v = static_cast<std::size_t>(vertex);
      if (v >= spared.size() || spared[v] || stroke.on_cut[v]) continue;
      spared[v] = any = true;
    }
    if (!any) break;
    attempt = attemptCut(question, stroke, patch, known, spared);
  }
  return attempt;
}

/// The topology before, its subdivision and its opening: what the edit is made of.
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

/// A surface triangle's vertices in the topology before: those that its own vertices lie between; ascending.
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

/// Per surface triangle whether a cut made it: it is no part of a triangle that was there and was no cut.
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
  after.bodies = tetBodies(after.tets, static_cast<int>(after.rest_vertices.rows()));
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

std::optional<TetEdit> cutTets(const TetTopology& topology, const std::vector<bool>& cut,
                               const CutPatch& patch, const SubdivisionSettings& settings, CutStroke* stroke,
                               std::string* reason) {
  requireUsable(patch);
  const PatchIntersector step(inGeneralPosition(patch));
  stroke->patch = joined(stroke->patch, step.mesh());
  stroke->on_cut.resize(static_cast<std::size_t>(topology.rest_vertices.rows()), false);
  const Points vertices = inSinglePrecision(topology.rest_vertices);
  const std::vector<EdgeCrossing> crossings = edgeCrossings(vertices, topology.tets, stroke->on_cut, step);
  const Attempt best = cutWithoutPinches({vertices, topology, crossings, settings}, *stroke);

  stroke->on_cut = best.subdivision.on_cut;
  stroke->closed_faces = best.crack.closed_faces;
  for (const int source : best.crack.opened.copied_from) {
    stroke->on_cut.push_back(stroke->on_cut[static_cast<std::size_t>(source)]);
  }
  if (best.subdivision.splits.empty() && best.crack.opened.copied_from.empty()) {
    *reason = crossings.empty() ? "the cut misses the body" : "the cut only grazes the body";
    return std::nullopt;
  }
  const CutSteps steps{topology, cut, best.subdivision, best.crack};
  return TetEdit{topologyAfter(steps), cutTriangles(steps), vertexOrigins(steps), successorsOf(steps)};
}

}  // namespace softbody
