#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "cutting/binding/surface_rebinding.h"

namespace softbody {

/// The visual surface of a body through strokes of the blade, undo and redo. It must be given the same
/// strokes, undos and redos as CutHistory. Undo restores mesh and binding bit for bit, except for the
/// revision. Copies share the surfaces.
class SurfaceHistory {
 public:
  explicit SurfaceHistory(VisualSurface uncut);

  const VisualSurface& surface() const { return versions_[at_]->surface; }

  /// The mesh after the next part of a stroke: the mesh before the stroke, cut along the whole stroke.
  /// Changes nothing. @throw std::invalid_argument as cutSurface.
  SurfaceCut preview(const CutPatch& patch, std::uint32_t stroke) const;

  /// The result for a mesh that cannot be cut: the mesh before the stroke.
  SurfaceCut uncutPreview(std::uint32_t stroke) const;

  /// Takes over the edit of the tets and the result of preview for the same patch and stroke. If the mesh was
  /// missed or refused, it stays as before the stroke. A new stroke begins as in CutHistory.
  /// @param volume state of the tets before the edit; in this state the edit must not move the surface.
  void cut(const CutPatch& patch, std::uint32_t stroke, SurfaceCut cut, const TetEdit& edit,
           const MeshState& volume);

  /// Adds to the stroke a part that does not cut anything yet.
  void advance(const CutPatch& patch, std::uint32_t stroke);

  /// @param revision of the tets after the same step. @return false if there is no stroke to undo or redo.
  bool undo(std::uint32_t revision);
  bool redo(std::uint32_t revision);
  bool reset(std::uint32_t revision);

  void setRevision(std::uint32_t revision);
  /// The next part of a stroke begins another stroke.
  void closeStroke();

  // The versions, as undo_versions.h uses them.
  std::size_t present() const { return at_; }
  bool has(std::size_t version) const { return versions_[version] != nullptr; }
  std::size_t bytes(std::size_t version) const { return versions_[version]->bytes; }
  void drop(std::size_t version) { versions_[version].reset(); }
  SurfaceHistory upTo(std::size_t version) const;
  void takeVersions(const SurfaceHistory& other);
  /// Keeps the strokes in force and adds undone ones without their versions.
  void setStrokeCount(std::size_t strokes);

 private:
  bool hasVersion(std::uint32_t stroke) const { return stroke_has_version_ && stroke_number_ == stroke; }
  CutPatch strokeWith(const CutPatch& patch, std::uint32_t stroke) const;
  bool moveTo(std::size_t version, std::uint32_t revision);

  struct Version {
    VisualSurface surface;
    std::optional<ManifoldMesh> manifold;  ///< form of its mesh; nothing if the mesh is not closed
    std::size_t bytes = 0;
  };
  static std::shared_ptr<const Version> makeVersion(VisualSurface surface,
                                                    std::optional<ManifoldMesh> manifold);

  /// The uncut surface, then one version per stroke; null: dropped.
  std::vector<std::shared_ptr<const Version>> versions_;
  std::size_t at_ = 0;
  std::vector<int> sources_;  ///< of the surface's vertices, in the mesh before the current stroke
  CutPatch stroke_;           ///< whole current stroke
  std::optional<std::uint32_t> stroke_number_;
  bool stroke_has_version_ = false;
};

}  // namespace softbody
