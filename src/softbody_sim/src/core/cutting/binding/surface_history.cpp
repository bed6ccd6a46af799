#include "cutting/binding/surface_history.h"

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

}  // namespace

SurfaceHistory::SurfaceHistory(VisualSurface uncut) {
  std::optional<ManifoldMesh> manifold = manifoldOf(uncut.topology());
  versions_.push_back(std::make_shared<Version>(Version{std::move(uncut), std::move(manifold)}));
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

void SurfaceHistory::advance(const CutPatch& patch, std::uint32_t stroke) {
  stroke_ = strokeWith(patch, stroke);
  stroke_has_version_ = hasVersion(stroke);
  stroke_number_ = stroke;
}

void SurfaceHistory::cut(const CutPatch& patch, std::uint32_t stroke, SurfaceCut cut, const TetEdit& edit,
                         const MeshState& volume) {
  advance(patch, stroke);
  if (!stroke_has_version_) sources_ = ownSources(surface().topology());
  MeshSources sources{cut.vertex_sources, cut.triangle_sources};
  ManifoldMesh manifold = std::move(cut.manifold);
  VisualSurface rebound = rebindSurface(surface(), sources_, std::move(cut), edit, volume);
  versions_.erase(versions_.begin() + static_cast<std::ptrdiff_t>(stroke_has_version_ ? at_ : at_ + 1),
                  versions_.end());
  versions_.push_back(std::make_shared<Version>(Version{std::move(rebound), std::move(manifold)}));
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
  at_ = version;
  auto renumbered = std::make_shared<Version>(*versions_[at_]);
  renumbered->surface.setRevision(revision);
  versions_[at_] = std::move(renumbered);
  stroke_number_.reset();
  stroke_has_version_ = false;
  return true;
}

}  // namespace softbody
