#pragma once

#include <memory>
#include <vector>

#include "softbody_common/geometry/types.h"
#include "softbody_sim/interpolation/tet_binding.h"
#include "softbody_sim/interpolation/tiled_weights.h"

namespace softbody {

/// The high-resolution mesh, driven by the low-resolution surface. Visual vertices inside this surface have
/// mean value coordinates (Ju et al. 2005). Visual vertices outside follow the nearest tet. Both agree on the
/// low-resolution surface, so the binding is continuous. After a cut all vertices follow tets: mean value
/// coordinates are undefined where the two walls of a slit coincide.
class VisualSurface {
 public:
  /// Computes the weights, once. @throw std::invalid_argument if the volume's surface is not closed.
  VisualSurface(MeshTopology visual, const TetTopology& volume);

  /// A surface with a tet for every vertex.
  VisualSurface(MeshTopology visual, TetBinding binding);

  const MeshTopology& topology() const { return visual_; }
  /// Covers all vertices; an uncut body uses it for the outside ones only.
  const TetBinding& binding() const { return binding_; }

  /// Sets the revision of mesh and binding.
  void setRevision(std::uint32_t revision);

  /// Memory without the weights, which copies share.
  std::size_t bytes() const;

  /// Number of visual vertices that lie outside the low-resolution surface by more than a rounding error.
  int outsideCount() const;

  /// Visual vertices, and their confidences, for a state of the volume.
  /// @throw std::invalid_argument if the revision or the number of vertices differs from the volume's.
  MeshState apply(const MeshState& volume) const;

 private:
  void bindInside(const TetTopology& volume);
  void applyInside(const MeshState& volume, MeshState* state) const;
  std::vector<float> standardDeviations(const MeshState& volume) const;

  MeshTopology visual_;
  TetBinding binding_;
  std::vector<int> surface_vertices_;  ///< of the volume, in ascending order
  std::vector<int> inside_;            ///< visual vertices
  /// #inside by #surface vertices, rows sum to 1; shared by copies. Null: no vertex is inside.
  std::shared_ptr<const TiledWeights> inside_weights_;
  std::vector<int> by_tet_;  ///< visual vertices
};

}  // namespace softbody
