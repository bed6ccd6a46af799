#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "softbody_common/cut.h"
#include "softbody_sim/cutting/cutting_config.h"
#include "softbody_sim/interpolation/visual_surface.h"

namespace softbody {

/// What a cut would do.
struct CutPreview {
  std::string refusal;          ///< why it cannot be made; empty if it can
  std::vector<double> volumes;  ///< of the pieces of the visual mesh, largest first [m^3]
  MeshTopology pieces;          ///< the visual mesh as it would be; empty if it cannot be cut
};

/// The visual mesh of a body that is cut, and the tets that it follows. A cut is made where the visual mesh
/// can be cut; the tets, which are coarser, follow as far as they go. A simulator that is given the same cuts
/// has the same tets.
class CuttableSurface {
 public:
  /// @throw std::invalid_argument if the volume's surface is not closed.
  CuttableSurface(const MeshTopology& visual, const TetTopology& volume, const CuttingConfig& config = {});
  ~CuttableSurface();
  CuttableSurface(CuttableSurface&&) noexcept;
  CuttableSurface& operator=(CuttableSurface&&) noexcept;

  const VisualSurface& surface() const;
  const TetTopology& volume() const;

  /// The cut that the blade's motion since the last call asks for, already carried out.
  /// @param blade polygon in the frame of the volume's state, the same one every time [m].
  /// @param volume state of the volume at that time; nothing is cut if it is of another revision.
  /// @param stamp of the blade. After a gap, or where time jumps back, no cut leads from where it was to
  /// where it is.
  std::optional<Cut> follow(const Points& blade, const MeshState& volume, Nanoseconds stamp);

  /// The blade is not seen.
  void lift();

  /// The cut that overstretched material asks for, already carried out: call it with every state. A tear is a
  /// stroke of its own. None leaves a piece of less than a hundredth of the body.
  /// @param volume its state; nothing tears if it is of another revision.
  std::optional<Cut> tear(const MeshState& volume);

  /// A cut of a stroke of its own; for apply(). The patch is rounded as it is published.
  Cut separateCut(const TriangleMesh& patch) const;
  /// Undo, redo or reset; for apply().
  Cut edit(CutKind kind) const;

  /// Carries out a cut. Nothing changes where it returns false, `reason` then says why, or throws.
  /// @param volume state of the volume before the cut: in it the visual mesh does not jump.
  /// @throw std::invalid_argument if the patch is no oriented surface.
  bool apply(const Cut& cut, const MeshState& volume, std::string* reason);

  /// The simulator has come to this revision, too: what was before is not needed for rollBack any more.
  /// Who never confirms keeps all of it.
  void confirm(std::uint32_t revision);

  /// Takes back the cuts after a revision that the simulator has not come beyond, as if they had never been
  /// made. @return false, and nothing is changed, if it is a later one or one before a confirmed one.
  bool rollBack(std::uint32_t revision);

  /// What separateCut(patch) would do. @throw std::invalid_argument if the patch is no oriented surface.
  CutPreview preview(const TriangleMesh& patch) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace softbody
