#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cutting/binding/surface_rebinding.h"
#include "cutting/volume/tet_cutter.h"
#include "softbody_common/cutting/edit_history.h"
#include "softbody_sim/cutting/tet_edits.h"

namespace softbody {

/// Bounds of a body that is cut.
struct CutLimits {
  std::size_t pieces = 0;
  std::size_t undo_bytes = 0;  ///< of the versions that are kept for undo and redo
};

/// @throw std::invalid_argument if a cut leaves too many.
void requireFewPieces(const MeshTopology& mesh, const CutLimits& limits);

/// The tets of a body, and its visual surface if it has one, through strokes of the blade, undo and redo. A
/// stroke is one undo step, whatever the number of its cuts. Undo restores tets, mesh and binding bit for
/// bit, except for the revision, which only increases. Undo and redo return to versions: the uncut body, then
/// one after each stroke. They are a cache: a version that was dropped is made again from the patches of its
/// strokes. Copies share the versions. Whoever needs all or nothing works on a copy: after an edit that is
/// refused or throws, a history must not be used.
class BodyHistory {
 public:
  BodyHistory(const TetTopology& uncut, std::optional<VisualSurface> surface);

  const TetTopology& topology() const { return present().topology; }
  const VisualSurface& surface() const { return *present().surface; }
  /// The uncut body; its revision may be a later one.
  const TetTopology& uncut() const { return versions_.front()->topology; }
  /// All edits since the uncut body.
  const EditHistory& edits() const { return edits_; }
  void setBody(std::uint64_t body) { edits_.body = body; }

  /// The mesh after the next part of a stroke: the mesh before the stroke, cut along the whole stroke.
  /// @throw std::invalid_argument as cutSurface.
  SurfaceCut preview(const CutPatch& patch, std::uint32_t stroke) const;

  /// Makes an edit. Without a visual surface a cut must cross a tet. With one, a patch that crosses no tet
  /// changes only the revision of the tets: it can cut the finer mesh. @param volume state of the tets before
  /// the edit; in this state the edit does not move the surface. @return null if the edit is not possible;
  /// `reason` then says why. @throw std::invalid_argument as cutTets and cutSurface.
  std::shared_ptr<const TetEdit> apply(const Cut& cut, const MeshState& volume, const CutLimits& limits,
                                       std::string* reason);

  /// Takes over a history of the same uncut body. The visual mesh is cut at rest, where that is possible.
  /// @return the edits of the tets from the present body. @throw as apply.
  TetEdits adopt(const EditHistory& edits, const CutLimits& limits);

  /// Drops versions if an edit returns to one that has to be made again, because that needs their memory. To
  /// be called before a copy is made.
  void makeRoomFor(const Cut& edit);
  /// Memory of the versions that may be dropped: not the uncut body, the present one, or the one before its
  /// stroke.
  std::size_t droppableBytes() const;
  /// Number of strokes, in force or undone, whose versions were dropped.
  std::size_t droppedVersions() const;

 private:
  struct Version {
    TetTopology topology;
    std::vector<bool> cut;                 ///< as in TetEdit
    std::vector<int> parents;              ///< per tet, the tet of the version before that contains it
    std::vector<int> uncut_tets;           ///< per tet, the tet of the uncut body that contains it
    std::optional<VisualSurface> surface;  ///< nothing if the body has none
    std::optional<ManifoldMesh> manifold;  ///< form of its mesh; nothing if the mesh is not closed
    std::size_t bytes = 0;
  };
  /// The stroke that goes on.
  struct OpenStroke {
    CutStroke tets;
    CutPatch patch;            ///< all of it
    std::vector<int> sources;  ///< of the surface's vertices, in the mesh before the stroke
  };

  const Version& present() const { return *versions_[edits_.in_force]; }
  bool goesOn(std::uint32_t stroke) const;
  const Version& start(std::uint32_t stroke) const;
  SurfaceCut meshAtRest(const Cut& cut) const;
  std::optional<TetEdit> grow(const Cut& cut, std::string* reason);
  TetEdit growOrAdvance(const Cut& cut);
  TetEdit unchanged() const;
  std::shared_ptr<const TetEdit> record(const Cut& cut, TetEdit edit, std::optional<SurfaceCut> mesh,
                                        const MeshState& volume);
  std::shared_ptr<const TetEdit> cutAtRest(const Cut& cut);
  void cutStroke(const Stroke& stroke);
  std::shared_ptr<const TetEdit> moveTo(const Cut& edit, const CutLimits& limits);
  void replaceStrokes(const EditHistory& edits, const CutLimits& limits);
  void restore(std::size_t version, const CutLimits& limits);
  void dropVersions(std::size_t limit);
  bool mayDrop(std::size_t version) const;
  void closeStroke();
  void setRevision(std::uint32_t revision);

  EditHistory edits_;
  std::vector<std::shared_ptr<const Version>> versions_;  ///< null: dropped
  OpenStroke open_;
};

}  // namespace softbody
