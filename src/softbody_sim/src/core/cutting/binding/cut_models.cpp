#include "cutting/binding/cut_models.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

#include "cutting/volume/undo_versions.h"

namespace softbody {
namespace {

/// State of a body at rest.
MeshState restOf(const TetTopology& volume) {
  MeshState rest;
  rest.revision = volume.revision;
  rest.vertices = volume.rest_vertices;
  rest.confidence.assign(static_cast<std::size_t>(rest.vertices.rows()), 0.0f);
  return rest;
}

std::size_t pieceCount(const MeshTopology& mesh) {
  const auto& pieces = mesh.triangle_pieces;
  return pieces.empty() ? 0 : *std::max_element(pieces.begin(), pieces.end()) + 1;
}

}  // namespace

void requireFewPieces(const MeshTopology& mesh, const CutLimits& limits) {
  const std::size_t pieces = pieceCount(mesh);
  if (pieces > limits.pieces) {
    throw std::invalid_argument(
        fmt::format("the cut would leave {} pieces; max_pieces allows up to {}", pieces, limits.pieces));
  }
}

bool CutModels::cut(const Cut& cut, const MeshState& state, const CutLimits& limits, std::string* reason) {
  *reason = refusalOf(cut, edits());
  if (!reason->empty()) return false;
  SurfaceCut surface_cut = surface.preview(cut.patch, cut.stroke);
  *reason = surface_cut.reason;
  if (surface_cut.outcome != CutOutcome::kCut) return false;
  requireFewPieces(surface_cut.mesh, limits);
  const TetEdit edit = tets.cutOrAdvance(cut.patch, cut.stroke);
  surface.cut(cut.patch, cut.stroke, std::move(surface_cut), edit, state);
  dropVersions(limits.undo_bytes, this);
  return true;
}

bool CutModels::move(const Cut& cut, const CutLimits& limits, std::string* reason) {
  const std::size_t version = versionAfter(cut, edits());
  if (!has(version)) restoreVersion(version, limits.undo_bytes, this);
  const std::optional<TetEdit> edit = applyCut(cut, &tets, reason);
  if (!edit) return false;
  const std::uint32_t revision = edit->topology.revision;
  if (cut.kind == CutKind::kUndo) surface.undo(revision);
  if (cut.kind == CutKind::kRedo) surface.redo(revision);
  if (cut.kind == CutKind::kReset) surface.reset(revision);
  dropVersions(limits.undo_bytes, this);
  return true;
}

void CutModels::cutAtRest(const CutPatch& patch, std::uint32_t stroke) {
  const MeshState rest = restOf(tets.topology());
  SurfaceCut surface_cut = surface.uncutPreview(stroke);
  try {
    SurfaceCut preview = surface.preview(patch, stroke);
    if (preview.outcome == CutOutcome::kCut) surface_cut = std::move(preview);
  } catch (const std::invalid_argument&) {
    // Another program cut the tets along a patch that the visual mesh cannot follow.
  }
  const TetEdit edit = tets.cutOrAdvance(patch, stroke);
  surface.cut(patch, stroke, std::move(surface_cut), edit, rest);
}

void CutModels::cutStroke(const Stroke& stroke) {
  for (const CutPatch& patch : stroke.patches) cutAtRest(patch, stroke.number);
  tets.closeStroke();
  surface.closeStroke();
}

void CutModels::takeVersions(const CutModels& other) {
  tets.takeVersions(other.tets);
  surface.takeVersions(other.surface);
}

void CutModels::adopt(const EditHistory& edits, const CutLimits& limits) {
  for (const Cut& edit : editsBetween(tets.edits(), edits)) {
    std::string reason;
    if (edit.kind == CutKind::kCut)
      cutAtRest(edit.patch, edit.stroke);
    else if (!move(edit, limits, &reason))
      throw std::invalid_argument(reason);
    dropVersions(limits.undo_bytes, this);
  }
  const bool same_strokes = sameEdits(tets.edits(), edits);
  tets.take(edits);
  surface.setRevision(edits.revision);
  if (same_strokes) return;
  surface.setStrokeCount(edits.strokes.size());
  if (!edits.is_open) surface.closeStroke();
}

}  // namespace softbody
