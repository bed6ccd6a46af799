#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "softbody_common/cutting/edit_history.h"
#include "softbody_sim/cutting/cutting_config.h"
#include "softbody_sim/cutting/tet_edits.h"
#include "softbody_sim/interpolation/visual_surface.h"

namespace softbody {

/// The result that a cut would have.
struct CutPreview {
  std::string refusal;          ///< why the cut is impossible; empty if it is possible
  std::vector<double> volumes;  ///< of the pieces of the visual mesh, largest first [m^3]
  MeshTopology pieces;          ///< the visual mesh after the cut; empty if the cut is impossible
};

/// A body that is cut: its tets, its visual mesh, the binding of the mesh to the tets, and the history of the
/// edits. An edit changes all of them and the follower, or nothing. A cut is made if the visual mesh can be
/// cut; the coarser tets follow it as far as possible. A body without a visual mesh is cut if its tets can be
/// cut. Bodies that get the same edits have the same tets.
class CuttableBody {
 public:
  /// Another model of the body, which follows the tets, for example a simulator. It is called before an edit
  /// is in force. If it throws, the edit is not made.
  using Follower = std::function<void(const TetEdits&)>;

  /// @throw std::invalid_argument if the volume's surface is not closed.
  CuttableBody(const MeshTopology& visual, const TetTopology& volume, const CuttingConfig& config = {},
               Follower follower = {});
  /// Without a visual mesh: surface(), preview(), follow() and tear() must not be called.
  explicit CuttableBody(const TetTopology& volume, const CuttingConfig& config = {}, Follower follower = {});
  ~CuttableBody();
  CuttableBody(CuttableBody&&) noexcept;
  CuttableBody& operator=(CuttableBody&&) noexcept;

  const VisualSurface& surface() const;
  const TetTopology& volume() const;
  /// The tets before all edits; their revision may be a later one.
  const TetTopology& uncutVolume() const;
  /// All edits since the uncut body.
  const EditHistory& edits() const;
  /// Identifies the uncut body in edits().
  void setBody(std::uint64_t body);
  /// Number of strokes whose undo or redo has to cut the body again, because its memory was full.
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

  /// Tears overstretched material; to be called with every state. @return the cut that was made, if any. A
  /// tear is a separate stroke. It never leaves a piece smaller than 1 % of the body. @param volume its
  /// state. If its revision differs, nothing tears. @param targets that led to this state: they say where the
  /// body tears. Those of another revision are not used.
  std::optional<Cut> tear(const MeshState& volume, const TargetSet& targets = {});

  /// A cut as a separate stroke, for apply(). The patch is rounded as it is published.
  Cut separateCut(const TriangleMesh& patch) const;
  /// Undo, redo or reset, for apply().
  Cut edit(CutKind kind) const;

  /// Makes an edit. If it returns false, with a `reason`, or throws, nothing has changed. @param volume state
  /// of the volume before the edit; in this state the edit does not move the visual mesh. @throw
  /// std::invalid_argument if the patch is not an oriented surface, or the cut would leave
  /// too many pieces; and what the follower throws.
  bool apply(const Cut& cut, const MeshState& volume, std::string* reason);

  /// Takes back the last edit, as if it had never been made: a simulator elsewhere has not made it. Nothing
  /// if there is none, or after adopt(). The follower is not told.
  void takeBack();

  /// The result of separateCut(patch). @throw std::invalid_argument as apply.
  CutPreview preview(const TriangleMesh& patch) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace softbody
