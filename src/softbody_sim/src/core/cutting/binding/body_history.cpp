#include "cutting/binding/body_history.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "cutting/volume/version_edits.h"

namespace softbody {
namespace {

/// Nothing for an open mesh: it can be simulated, but cutting it throws.
std::optional<ManifoldMesh> manifoldOf(const MeshTopology& mesh) {
  try {
    return splitNonManifold(listOf(mesh.triangles), mesh.rest_vertices);
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
}

std::size_t bytesOf(const ManifoldMesh& manifold) {
  return manifold.triangles.size() * sizeof(manifold.triangles[0]) +
         (manifold.mates.size() + manifold.copied_from.size()) * sizeof(int);
}

std::size_t bytesOf(const TetTopology& t) {
  return static_cast<std::size_t>(t.rest_vertices.size()) * sizeof(double) +
         (static_cast<std::size_t>(t.tets.size() + t.surface.size()) + t.vertex_parents.size() +
          t.tet_pieces.size()) *
             sizeof(int);
}

std::vector<int> ownTets(const TetTopology& topology) {
  std::vector<int> own(static_cast<std::size_t>(topology.tets.rows()));
  std::iota(own.begin(), own.end(), 0);
  return own;
}

/// Per tet, the ancestor of its parent.
std::vector<int> ancestorsOf(std::vector<int> parents, const std::vector<int>& ancestors) {
  for (int& tet : parents) tet = ancestors[static_cast<std::size_t>(tet)];
  return parents;
}

MeshState restOf(const TetTopology& volume) {
  MeshState rest;
  rest.revision = volume.revision;
  rest.vertices = volume.rest_vertices;
  rest.confidence.assign(static_cast<std::size_t>(rest.vertices.rows()), 0.0f);
  return rest;
}

std::shared_ptr<const TetEdit> withRevision(TetEdit edit, std::uint32_t revision) {
  edit.topology.revision = revision;
  return std::make_shared<const TetEdit>(std::move(edit));
}

/// The version that an edit returns to. A cut and an impossible edit return to none: the present version.
std::size_t versionAfter(const Cut& edit, const EditHistory& edits) {
  if (edit.kind == CutKind::kReset) return 0;
  if (edit.kind == CutKind::kUndo && edits.in_force > 0) return edits.in_force - 1;
  if (edit.kind == CutKind::kRedo && edits.in_force < edits.strokes.size()) return edits.in_force + 1;
  return edits.in_force;
}

}  // namespace

void requireFewPieces(const MeshTopology& mesh, const CutLimits& limits) {
  const auto& pieces = mesh.triangle_pieces;
  const std::size_t count = pieces.empty() ? 0 : *std::max_element(pieces.begin(), pieces.end()) + 1;
  if (count <= limits.pieces) return;
  throw std::invalid_argument(
      fmt::format("the cut would leave {} pieces; max_pieces allows up to {}", count, limits.pieces));
}

BodyHistory::BodyHistory(const TetTopology& uncut, std::optional<VisualSurface> surface) {
  const std::vector<bool> none(static_cast<std::size_t>(uncut.surface.rows()), false);
  Version version{uncut, none, {}, ownTets(uncut), std::move(surface), {}};
  if (version.surface) version.manifold = manifoldOf(version.surface->topology());
  versions_.push_back(std::make_shared<const Version>(std::move(version)));
  edits_.revision = uncut.revision;
}

bool BodyHistory::goesOn(std::uint32_t stroke) const {
  return edits_.is_open && edits_.strokes[edits_.in_force - 1].number == stroke;
}

/// The version before a stroke.
const BodyHistory::Version& BodyHistory::start(std::uint32_t stroke) const {
  return *versions_[goesOn(stroke) ? edits_.in_force - 1 : edits_.in_force];
}

SurfaceCut BodyHistory::preview(const CutPatch& patch, std::uint32_t stroke) const {
  const Version& before = start(stroke);
  const MeshTopology& mesh = before.surface->topology();
  const CutPatch whole = goesOn(stroke) ? joined(open_.patch, patch) : patch;
  return before.manifold ? cutSurface(mesh, *before.manifold, whole) : cutSurface(mesh, whole);
}

std::shared_ptr<const TetEdit> BodyHistory::apply(const Cut& cut, const MeshState& volume,
                                                  const CutLimits& limits, std::string* reason) {
  *reason = refusalOf(cut, edits_);
  if (!reason->empty()) return nullptr;
  std::shared_ptr<const TetEdit> edit;
  if (cut.kind != CutKind::kCut) {
    edit = moveTo(cut, limits);
  } else if (present().surface) {
    SurfaceCut mesh = preview(cut.patch, cut.stroke);
    *reason = mesh.reason;
    if (mesh.outcome != CutOutcome::kCut) return nullptr;
    requireFewPieces(mesh.mesh, limits);
    edit = record(cut, growOrAdvance(cut), std::move(mesh), volume);
  } else {
    std::optional<TetEdit> crossing = grow(cut, reason);
    if (!crossing) return nullptr;
    edit = record(cut, *std::move(crossing), {}, volume);
  }
  dropVersions(limits.undo_bytes);
  return edit;
}

/// The next part of a stroke in the tets. @return nothing, with a reason, if it crosses none.
std::optional<TetEdit> BodyHistory::grow(const Cut& cut, std::string* reason) {
  if (!goesOn(cut.stroke)) open_ = {};
  open_.patch = joined(open_.patch, cut.patch);
  return cutTets(topology(), present().cut, cut.patch, {}, &open_.tets, reason);
}

TetEdit BodyHistory::growOrAdvance(const Cut& cut) {
  std::string reason;
  if (std::optional<TetEdit> edit = grow(cut, &reason)) return *std::move(edit);
  TetEdit edit = unchanged();
  ++edit.topology.revision;
  return edit;
}

TetEdit BodyHistory::unchanged() const {
  return editBack(topology(), topology(), present().cut, ownTets(topology()));
}

/// Adds a version: an edit of the tets, and the mesh before the stroke after the whole stroke.
std::shared_ptr<const TetEdit> BodyHistory::record(const Cut& cut, TetEdit edit,
                                                   std::optional<SurfaceCut> mesh, const MeshState& volume) {
  const bool goes_on = goesOn(cut.stroke);
  const Version &before = start(cut.stroke), &now = present();
  const auto made = std::make_shared<const TetEdit>(std::move(edit));
  Version next{made->topology, made->cut, parentsOf(*made), {}, {}, {}};
  next.uncut_tets = ancestorsOf(next.parents, now.uncut_tets);
  if (goes_on) next.parents = ancestorsOf(std::move(next.parents), now.parents);
  if (mesh) {
    if (!goes_on) open_.sources = ownSources(now.surface->topology().rest_vertices.rows());
    std::vector<int> sources = mesh->vertex_sources;
    next.manifold = mesh->outcome == CutOutcome::kCut ? std::move(mesh->manifold) : before.manifold;
    next.surface = rebindSurface(*now.surface, open_.sources, *std::move(mesh), *made, volume);
    open_.sources = std::move(sources);
    next.bytes = next.surface->bytes() + (next.manifold ? bytesOf(*next.manifold) : 0);
  }
  next.bytes += bytesOf(next.topology) + 2 * next.parents.size() * sizeof(int) + next.cut.size() / 8;
  addEdit({made->topology.revision, cut.stroke, CutKind::kCut, cut.patch}, &edits_);
  versions_.resize(edits_.in_force);
  versions_.push_back(std::make_shared<const Version>(std::move(next)));
  return made;
}

/// The mesh after a cut, or as before the stroke if it cannot be cut.
SurfaceCut BodyHistory::meshAtRest(const Cut& cut) const {
  try {
    SurfaceCut mesh = preview(cut.patch, cut.stroke);
    if (mesh.outcome == CutOutcome::kCut) return mesh;
  } catch (const std::invalid_argument&) {
    // Another program cut the tets along a patch that the visual mesh cannot follow.
  }
  const MeshTopology& mesh = start(cut.stroke).surface->topology();
  const std::vector<bool> none(static_cast<std::size_t>(mesh.triangles.rows()));
  return {CutOutcome::kMissed, "", mesh, ownSources(mesh.rest_vertices.rows()), none, {}};
}

/// Cuts the tets, and the visual mesh where that is possible.
std::shared_ptr<const TetEdit> BodyHistory::cutAtRest(const Cut& cut) {
  const MeshState rest = restOf(topology());
  std::optional<SurfaceCut> mesh;
  if (present().surface) mesh = meshAtRest(cut);
  return record(cut, growOrAdvance(cut), std::move(mesh), rest);
}

std::shared_ptr<const TetEdit> BodyHistory::moveTo(const Cut& edit, const CutLimits& limits) {
  const std::size_t version = versionAfter(edit, edits_);
  restore(version, limits);
  const Version &now = present(), &then = *versions_[version];
  TetEdit made = edit.kind == CutKind::kRedo
                     ? editForward(now.topology, then.topology, then.cut, then.parents)
                     : editBack(now.topology, then.topology, then.cut,
                                edit.kind == CutKind::kUndo ? now.parents : now.uncut_tets);
  addEdit(edit, &edits_);
  closeStroke();
  setRevision(edits_.revision);
  return withRevision(std::move(made), edits_.revision);
}

TetEdits BodyHistory::adopt(const EditHistory& edits, const CutLimits& limits) {
  TetEdits made;
  if (const std::optional<Cut> next = nextEdit(edits_, edits)) {
    made = {next->kind == CutKind::kCut ? cutAtRest(*next) : moveTo(*next, limits)};
  } else if (sameEdits(edits_, edits)) {
    made = {withRevision(unchanged(), edits.revision)};
  } else {
    const Version &uncut = *versions_.front(), &now = present();
    made = {withRevision(editBack(now.topology, uncut.topology, uncut.cut, now.uncut_tets), edits.revision)};
    replaceStrokes(edits, limits);
    const Version& then = present();
    made.push_back(
        withRevision(editForward(uncut.topology, then.topology, then.cut, then.uncut_tets), edits.revision));
  }
  edits_ = edits;
  setRevision(edits.revision);
  dropVersions(limits.undo_bytes);
  return made;
}

/// Keeps the versions of the first strokes that both histories have. A stroke that goes on is cut again: what
/// its next part needs to know is not in its version.
void BodyHistory::replaceStrokes(const EditHistory& edits, const CutLimits& limits) {
  std::size_t common = commonStrokes(edits_, edits);
  if (edits.is_open) common = std::min(common, edits.in_force - 1);
  edits_ = edits;
  versions_.resize(common + 1);
  versions_.resize(edits.strokes.size() + 1);
  open_ = {};
  restore(edits.in_force, limits);
  if (!edits.is_open) closeStroke();
}

/// Makes a version that was dropped. The last stroke before it then is the open one.
void BodyHistory::restore(std::size_t version, const CutLimits& limits) {
  std::size_t start = version;
  while (!versions_[start]) --start;
  if (start == version) return;
  BodyHistory again = *this;
  again.versions_.resize(start + 1);
  again.edits_.strokes.resize(start);
  again.edits_.in_force = start;
  again.edits_.revision = again.topology().revision;
  for (std::size_t k = start; k < version; ++k) {
    again.cutStroke(edits_.strokes[k]);
    again.dropVersions(limits.undo_bytes);
  }
  for (std::size_t k = start; k < again.versions_.size(); ++k) {
    if (!versions_[k]) versions_[k] = again.versions_[k];
  }
  open_ = std::move(again.open_);
}

void BodyHistory::cutStroke(const Stroke& stroke) {
  closeStroke();
  for (const CutPatch& patch : stroke.patches)
    cutAtRest({edits_.revision + 1, stroke.number, CutKind::kCut, patch});
}

void BodyHistory::closeStroke() {
  open_ = {};
  edits_.is_open = false;
}

void BodyHistory::setRevision(std::uint32_t revision) {
  edits_.revision = revision;
  if (topology().revision == revision) return;
  Version renumbered = present();
  renumbered.topology.revision = revision;
  if (renumbered.surface) renumbered.surface->setRevision(revision);
  versions_[edits_.in_force] = std::make_shared<const Version>(std::move(renumbered));
}

bool BodyHistory::mayDrop(std::size_t version) const {
  return version != 0 && version != edits_.in_force && version + 1 != edits_.in_force && versions_[version];
}

std::size_t BodyHistory::droppableBytes() const {
  std::size_t bytes = 0;
  for (std::size_t k = 0; k < versions_.size(); ++k) bytes += mayDrop(k) ? versions_[k]->bytes : 0;
  return bytes;
}

/// Drops versions until the others that may be dropped need at most `limit` bytes, those furthest from the
/// present one first.
void BodyHistory::dropVersions(std::size_t limit) {
  const std::size_t present = edits_.in_force;
  const auto distance = [present](std::size_t k) { return k < present ? present - k : k - present; };
  for (std::size_t used = droppableBytes(); used > limit;) {
    std::size_t furthest = present;
    for (std::size_t k = 0; k < versions_.size(); ++k)
      if (mayDrop(k) && distance(k) > distance(furthest)) furthest = k;
    used -= versions_[furthest]->bytes;
    versions_[furthest].reset();
  }
}

void BodyHistory::makeRoomFor(const Cut& edit) {
  if (!versions_[versionAfter(edit, edits_)]) dropVersions(0);
}

std::size_t BodyHistory::droppedVersions() const {
  return static_cast<std::size_t>(std::count(versions_.begin(), versions_.end(), nullptr));
}

}  // namespace softbody
