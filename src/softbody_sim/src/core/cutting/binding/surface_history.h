#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "cutting/binding/surface_rebinding.h"

namespace softbody {

/// The visual surface of a body through strokes of the blade, undo and redo: CutHistory's companion, to be
/// given the same strokes, undos and redos. An undone surface is the one from before, mesh and binding, bit
/// for bit, but for its revision. Copies share the surfaces.
class SurfaceHistory {
 public:
  explicit SurfaceHistory(VisualSurface uncut);

  const VisualSurface& surface() const { return versions_[at_]->surface; }

  /// The mesh after the next part of a stroke: the mesh from before the stroke, cut along all of the stroke.
  /// Nothing is changed. @throw std::invalid_argument as cutSurface.
  SurfaceCut preview(const CutPatch& patch, std::uint32_t stroke) const;

  /// Goes on to the tets after their edit and to what preview gave for the same patch and stroke. A mesh that
  /// was missed or refused is as before the stroke. A new stroke begins as in CutHistory.
  /// @param volume state of the tets before the edit, in which nothing is to jump.
  void cut(const CutPatch& patch, std::uint32_t stroke, SurfaceCut cut, const TetEdit& edit,
           const MeshState& volume);

  /// Adds to the stroke a part that changes nothing yet: no tet is cut.
  void advance(const CutPatch& patch, std::uint32_t stroke);

  /// @param revision the tets' after theirs. @return false if there is no stroke to undo, or to redo.
  bool undo(std::uint32_t revision);
  bool redo(std::uint32_t revision);
  bool reset(std::uint32_t revision);

 private:
  bool hasVersion(std::uint32_t stroke) const { return stroke_has_version_ && stroke_number_ == stroke; }
  CutPatch strokeWith(const CutPatch& patch, std::uint32_t stroke) const;
  bool moveTo(std::size_t version, std::uint32_t revision);

  struct Version {
    VisualSurface surface;
    std::optional<ManifoldMesh> manifold;  ///< of its mesh; none if that is not closed
  };
  std::vector<std::shared_ptr<const Version>> versions_;  ///< the uncut surface, then after each stroke
  std::size_t at_ = 0;
  MeshSources sources_;  ///< of the surface, in the mesh before the current stroke
  CutPatch stroke_;      ///< all of the current one
  std::optional<std::uint32_t> stroke_number_;
  bool stroke_has_version_ = false;
};

}  // namespace softbody
