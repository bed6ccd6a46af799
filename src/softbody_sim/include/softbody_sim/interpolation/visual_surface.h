#pragma once

#include <memory>
#include <vector>

#include "softbody_common/types.h"
#include "softbody_sim/interpolation/tet_binding.h"
#include "softbody_sim/interpolation/tiled_weights.h"

namespace softbody {

/// The high-resolution mesh driven by the low-resolution surface: mean value coordinates (Ju et al. 2005) for
/// the visual vertices inside of it, the nearest tet for those outside. On the low-resolution surface both
/// agree, so the binding is continuous. After a cut all follow tets: near a slit, whose two walls coincide,
/// mean value coordinates are unusable.
class VisualSurface {
 public:
  /// Computes the weights, once. @throw std::invalid_argument if the volume's surface is not closed.
  VisualSurface(MeshTopology visual, const TetTopology& volume);

  /// A surface all of whose vertices follow tets.
  VisualSurface(MeshTopology visual, TetBinding binding);

  const MeshTopology& topology() const { return visual_; }
  /// Of all vertices, though in an uncut body only those outside follow their tets.
  const TetBinding& binding() const { return binding_; }

  /// Gives mesh and binding another revision, the same for both.
  void setRevision(std::uint32_t revision);

  /// Number of visual vertices that lie outside the low-resolution surface by more than rounding.
  int outsideCount() const;

  /// Visual vertices, and their confidences, for a state of the volume.
  /// @throw std::invalid_argument if the revision or the number of vertices is not the volume's.
  MeshState apply(const MeshState& volume) const;

 private:
  void bindInside(const TetTopology& volume);
  void applyInside(const MeshState& volume, MeshState* state) const;

  MeshTopology visual_;
  TetBinding binding_;
  std::vector<int> surface_vertices_;  ///< of the volume, in ascending order
  std::vector<int> inside_;            ///< visual vertices
  /// #inside by #surface vertices, rows sum to 1; shared by copies. Null: none is inside.
  std::shared_ptr<const TiledWeights> inside_weights_;
  std::vector<int> by_tet_;  ///< visual vertices
};

}  // namespace softbody
