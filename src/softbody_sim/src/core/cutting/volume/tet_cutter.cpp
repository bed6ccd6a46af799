#include "cutting/volume/tet_cutter.h"

#include <algorithm>
#include <iterator>
#include <stdexcept>

#include "cutting/volume/cut_faces.h"
#include "cutting/volume/edge_crossings.h"
#include "cutting/volume/manifold.h"

namespace softbody {
namespace {

void requireUsable(const CutPatch& patch) {
  if (!patch.vertices.allFinite()) throw std::invalid_argument("the cut's patch is not finite");
  const auto count = patch.vertices.rows();
  if (patch.triangles.size() > 0 && (patch.triangles.minCoeff() < 0 || patch.triangles.maxCoeff() >= count))
    throw std::invalid_argument("the cut's patch refers to a vertex that does not exist");
}

/// The inputs that all attempts share.
struct Crossed {
  const Points& vertices;
  const TetTopology& topology;
  const std::vector<EdgeCrossing>& crossings;
  const SubdivisionSettings& settings;
};

/// A subdivision, and the crack along it.
struct Attempt {
  CutSubdivision subdivision;
  ManifoldCrack crack;
};

Attempt attemptCut(const Crossed& crossed, const CutStroke& stroke, const PatchIntersector& patch,
                   const std::vector<int>& known, const std::vector<bool>& spared) {
  Attempt attempt;
  const Tets& tets = crossed.topology.tets;
  attempt.subdivision =
      subdivide(crossed.vertices, tets, crossed.crossings, crossed.settings, stroke.on_cut, spared);
  const CutSubdivision& s = attempt.subdivision;
  const std::vector<Face> along = facesAlong(patch, s.vertices, s.parts.tets, s.on_cut);
  std::vector<Face> faces;
  std::set_union(along.begin(), along.end(), stroke.closed_faces.begin(), stroke.closed_faces.end(),
                 std::back_inserter(faces));
  attempt.crack = openManifoldCrack(s.parts.tets, static_cast<int>(s.vertices.rows()), faces, known);
  return attempt;
}

/// Spares the pinched vertices that were not on the cut before. @return whether one is new.
bool spare(const std::vector<int>& pinches, const std::vector<bool>& on_cut, std::vector<bool>* spared) {
  bool any = false;
  for (const int vertex : pinches) {
    const auto v = static_cast<std::size_t>(vertex);
    if (v >= spared->size() || (*spared)[v] || on_cut[v]) continue;
    (*spared)[v] = any = true;
  }
  return any;
}

/// Cuts. If a vertex that was put on the cut pinches the surface, cuts again without it.
Attempt cutWithoutPinches(const Crossed& crossed, const CutStroke& stroke) {
  constexpr int kAttempts = 4;  // a bound; each spares one more vertex
  const PatchIntersector patch(stroke.patch);
  const std::vector<int> known = nonManifoldVertices(crossed.topology.surface);
  std::vector<bool> spared(stroke.on_cut.size(), false);
  Attempt attempt = attemptCut(crossed, stroke, patch, known, spared);
  for (int k = 1; k < kAttempts && spare(attempt.crack.pinches, stroke.on_cut, &spared); ++k) {
    attempt = attemptCut(crossed, stroke, patch, known, spared);
  }
  return attempt;
}

}  // namespace

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
  return assembleEdit(topology, cut, best.subdivision, best.crack);
}

}  // namespace softbody
