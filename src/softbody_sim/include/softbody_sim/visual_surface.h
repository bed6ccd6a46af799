#pragma once

#include "softbody_common/types.h"

namespace softbody {

/// The high-resolution mesh driven by the low-resolution surface: mean value coordinates (Ju et al. 2005) for the visual
/// vertices inside of it, the nearest tet for those outside. On the low-resolution surface both agree, so the binding is
/// continuous.
class VisualSurface {
 public:
  /// Computes the weights, once. @throw std::invalid_argument if the volume's surface is not closed.
  VisualSurface(MeshTopology visual, const TetTopology& volume);

  const MeshTopology& topology() const { return visual_; }

  /// Number of visual vertices that lie outside the low-resolution surface.
  int outsideCount() const;

  /// Visual vertices, and their confidences, for a state of the volume.
  /// @throw std::invalid_argument if the revision or the number of vertices is not the volume's.
  MeshState apply(const MeshState& volume) const;

 private:
  MeshTopology visual_;
};

}  // namespace softbody
