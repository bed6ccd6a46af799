#include "cutting/binding/surface_history.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

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

std::size_t bytesOf(const std::optional<ManifoldMesh>& manifold) {
  if (!manifold) return 0;
  return manifold->triangles.size() * sizeof(manifold->triangles[0]) +
         (manifold->mates.size() + manifold->copied_from.size()) * sizeof(int);
}

}  // namespace

SurfaceHistory::SurfaceHistory(VisualSurface uncut) {
  std::optional<ManifoldMesh> manifold = manifoldOf(uncut.topology());
  versions_.push_back(makeVersion(std::move(uncut), std::move(manifold)));
}

std::shared_ptr<const SurfaceHistory::Version> SurfaceHistory::makeVersion(
    VisualSurface surface, std::optional<ManifoldMesh> manifold) {
  const std::size_t bytes = surface.bytes() + bytesOf(manifold);
  return std::make_shared<Version>(Version{std::move(surface), std::move(manifold), bytes});
}

CutPatch SurfaceHistory::strokeWith(const CutPatch& patch, std::uint32_t stroke) const {
  return stroke_number_ == stroke ? joined(stroke_, patch) : patch;
}

SurfaceCut SurfaceHistory::preview(const CutPatch& patch, std::uint32_t stroke) const {
  const Version& start = *versions_[hasVersion(stroke) ? at_ - 1 : at_];
  const MeshTopology& mesh = start.surface.topology();
  const CutPatch whole = strokeWith(patch, stroke);
  return start.manifold ? cutSurface(mesh, *start.manifold, whole) : cutSurface(mesh, whole);
}

SurfaceCut SurfaceHistory::uncutPreview(std::uint32_t stroke) const {
  const MeshTopology& mesh = versions_[hasVersion(stroke) ? at_ - 1 : at_]->surface.topology();
  return {CutOutcome::kMissed,
          "",
          mesh,
          ownSources(mesh.rest_vertices.rows()),
          std::vector<bool>(static_cast<std::size_t>(mesh.triangles.rows())),
          {}};
}

void SurfaceHistory::advance(const CutPatch& patch, std::uint32_t stroke) {
  stroke_ = strokeWith(patch, stroke);
  stroke_has_version_ = hasVersion(stroke);
  stroke_number_ = stroke;
}

void SurfaceHistory::cut(const CutPatch& patch, std::uint32_t stroke, SurfaceCut cut, const TetEdit& edit,
                         const MeshState& volume) {
  advance(patch, stroke);
  if (!stroke_has_version_) sources_ = ownSources(surface().topology().rest_vertices.rows());
  std::vector<int> sources = cut.vertex_sources;
  std::optional<ManifoldMesh> manifold = versions_[stroke_has_version_ ? at_ - 1 : at_]->manifold;
  if (cut.outcome == CutOutcome::kCut) manifold = std::move(cut.manifold);
  VisualSurface rebound = rebindSurface(surface(), sources_, std::move(cut), edit, volume);
  versions_.erase(versions_.begin() + static_cast<std::ptrdiff_t>(stroke_has_version_ ? at_ : at_ + 1),
                  versions_.end());
  versions_.push_back(makeVersion(std::move(rebound), std::move(manifold)));
  at_ = versions_.size() - 1;
  sources_ = std::move(sources);
  stroke_has_version_ = true;
}

bool SurfaceHistory::undo(std::uint32_t revision) { return at_ > 0 && moveTo(at_ - 1, revision); }

bool SurfaceHistory::redo(std::uint32_t revision) {
  return at_ + 1 < versions_.size() && moveTo(at_ + 1, revision);
}

bool SurfaceHistory::reset(std::uint32_t revision) { return at_ > 0 && moveTo(0, revision); }

bool SurfaceHistory::moveTo(std::size_t version, std::uint32_t revision) {
  if (!has(version)) throw std::logic_error("the version of an undo or redo was dropped");
  at_ = version;
  setRevision(revision);
  closeStroke();
  return true;
}

void SurfaceHistory::setRevision(std::uint32_t revision) {
  if (surface().topology().revision == revision) return;
  auto renumbered = std::make_shared<Version>(*versions_[at_]);
  renumbered->surface.setRevision(revision);
  versions_[at_] = std::move(renumbered);
}

void SurfaceHistory::closeStroke() {
  stroke_number_.reset();
  stroke_has_version_ = false;
}

SurfaceHistory SurfaceHistory::upTo(std::size_t version) const {
  SurfaceHistory copy = *this;
  copy.closeStroke();
  copy.versions_.resize(version + 1);
  copy.at_ = version;
  return copy;
}

void SurfaceHistory::takeVersions(const SurfaceHistory& other) {
  for (std::size_t k = 0; k < std::min(versions_.size(), other.versions_.size()); ++k) {
    if (!versions_[k]) versions_[k] = other.versions_[k];
  }
}

void SurfaceHistory::setStrokeCount(std::size_t strokes) {
  versions_.resize(at_ + 1);
  versions_.resize(strokes + 1);
}

}  // namespace softbody
