#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "softbody_common/cutting/edit_history.h"
#include "softbody_sim/cutting/cutting_config.h"
#include "softbody_sim/interpolation/visual_surface.h"

namespace softbody {

/// The result that a cut would have.
struct CutPreview {
  std::string refusal;          ///< why the cut is impossible; empty if it is possible
  std::vector<double> volumes;  ///< of the pieces of the visual mesh, largest first [m^3]
  MeshTopology pieces;          ///< the visual mesh after the cut; empty if the cut is impossible
};

/// The visual mesh of a body that is cut, and the tets that it is bound to. A cut is made if the visual mesh
/// can be cut. The coarser tets follow it as far as possible. A simulator that gets the same cuts has the
/// same tets.
class CuttableSurface {
 public:
  /// @throw std::invalid_argument if the volume's surface is not closed.
  CuttableSurface(const MeshTopology& visual, const TetTopology& volume, const CuttingConfig& config = {});
  ~CuttableSurface();
  CuttableSurface(CuttableSurface&&) noexcept;
  CuttableSurface& operator=(CuttableSurface&&) noexcept;

  const VisualSurface& surface() const;
  const TetTopology& volume() const;
  /// The tets before all edits; their revision may be a later one.
  const TetTopology& uncutVolume() const;
  /// All edits since the uncut body.
  const EditHistory& edits() const;
  /// Identifies the uncut body in edits().
  void setBody(std::uint64_t body);
  /// Number of strokes whose undo or redo has to cut the body again, because undo_memory_mb was full.
  std::size_t droppedVersions() const;

  /// Makes the strokes that are in force in a history of the same uncut body, and can undo and redo its
  /// strokes. The visual mesh may then differ from the one that was cut while it moved, by less than the
  /// bending within a tet. @throw std::invalid_argument if the patches are not usable; nothing has changed.
  void adopt(const EditHistory& edits);

  /// Cuts along the motion of the blade since the last call. @return the cut that was made, if any.
  /// @param blade polygon in the frame of the volume's state, the same in every call [m].
  /// @param volume state of the volume at that time. If its revision differs, nothing is cut.
  /// @param stamp of the blade. Motion across a gap or a jump back in time cuts nothing.
  /// @throw std::invalid_argument if the stroke is too long, or the cut would leave too many pieces.
  std::optional<Cut> follow(const Points& blade, const MeshState& volume, Nanoseconds stamp);

  /// To be called when the blade is not seen.
  void lift();

  /// Tears overstretched material; to be called with every state. @return the cut that was made, if any. A
  /// tear is a separate stroke. It never leaves a piece smaller than 1 % of the body. @param volume its
  /// state. If its revision differs, nothing tears. @param targets that led to this state: they say where the
  /// body tears. Those of another revision are not used.
  std::optional<Cut> tear(const MeshState& volume, const TargetSet& targets = {});

  /// A cut as a separate stroke, for apply(). The patch is rounded as it is published.
  Cut separateCut(const TriangleMesh& patch) const;
  /// Undo, redo or reset, for apply().
  Cut edit(CutKind kind) const;

  /// Makes a cut. If it returns false, with a `reason`, or throws, nothing has changed. @param volume state
  /// of the volume before the cut; in this state the cut does not move the visual mesh. @throw
  /// std::invalid_argument if the patch is not an oriented surface, or the cut would leave
  /// too many pieces.
  bool apply(const Cut& cut, const MeshState& volume, std::string* reason);

  /// To be called when the simulator has reached this revision. It frees the memory of earlier revisions, so
  /// rollBack can no longer return to them.
  void confirm(std::uint32_t revision);

  /// Removes the cuts after the revision that the simulator has reached, as if they had never been made.
  /// @return false, without any change, if the revision is in the future or earlier than a confirmed one.
  bool rollBack(std::uint32_t revision);

  /// The result of separateCut(patch). @throw std::invalid_argument as apply.
  CutPreview preview(const TriangleMesh& patch) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace softbody
