#pragma once

#include <vector>

#include "softbody_common/types.h"
#include "softbody_sim/tiled_weights.h"

namespace softbody {

/// The high-resolution mesh driven by the low-resolution surface: mean value coordinates (Ju et al. 2005) for
/// the visual vertices inside of it, the nearest tet for those outside. On the low-resolution surface both
/// agree, so the binding is continuous.
class VisualSurface {
 public:
  /// Computes the weights, once. @throw std::invalid_argument if the volume's surface is not closed.
  VisualSurface(MeshTopology visual, const TetTopology& volume);

  const MeshTopology& topology() const { return visual_; }

  /// Number of visual vertices that lie outside the low-resolution surface by more than rounding.
  int outsideCount() const;

  /// Visual vertices, and their confidences, for a state of the volume.
  /// @throw std::invalid_argument if the revision or the number of vertices is not the volume's.
  MeshState apply(const MeshState& volume) const;

 private:
  void bindInside(const TetTopology& volume);
  void bindOutside(const TetTopology& volume);
  void applyInside(const MeshState& volume, MeshState* state) const;
  void applyOutside(const MeshState& volume, MeshState* state) const;

  MeshTopology visual_;
  std::uint32_t volume_revision_;
  Eigen::Index volume_vertex_count_;
  Tets tets_;
  std::vector<int> surface_vertices_;  ///< of the volume, in ascending order
  std::vector<int> inside_;            ///< visual vertices
  TiledWeights inside_weights_;        ///< #inside by #surface vertices, rows sum to 1
  std::vector<int> outside_;           ///< visual vertices
  std::vector<MaterialPoint> outside_places_;
};

}  // namespace softbody
