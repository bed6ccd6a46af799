#pragma once

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

 private:
  bool hasVersion(std::uint32_t stroke) const { return stroke_has_version_ && stroke_number_ == stroke; }
  CutPatch strokeWith(const CutPatch& patch, std::uint32_t stroke) const;
  bool moveTo(std::size_t version, std::uint32_t revision);

  struct Version {
    VisualSurface surface;
    std::optional<ManifoldMesh> manifold;  ///< form of its mesh; nothing if the mesh is not closed
  };
  std::vector<std::shared_ptr<const Version>> versions_;  ///< the uncut surface, then after each stroke
  std::size_t at_ = 0;
  MeshSources sources_;  ///< of the surface, in the mesh before the current stroke
  CutPatch stroke_;      ///< whole current stroke
  std::optional<std::uint32_t> stroke_number_;
  bool stroke_has_version_ = false;
};

}  // namespace softbody
