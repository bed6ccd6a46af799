#pragma once

#include <Eigen/Core>
#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// Points that move with tets. At rest each point is at its material place. Corrections can shift the points
/// to given positions in one deformed state. A correction is stored in the material frame of the point's tet,
/// so that it turns and stretches with the tet. If that tet is too flat, the frame of a neighbour is used.
/// The correction is scaled by the strain of the piece over the strain at which the correction was made (or
/// over a larger one that would explain its size): 0 at rest, at most 1.
class TetBinding {
 public:
  TetBinding(const TetTopology& volume, std::vector<MaterialPoint> places);

  const TetTopology& volume() const { return volume_; }
  const std::vector<MaterialPoint>& places() const { return places_; }
  void setRevision(std::uint32_t revision) { volume_.revision = revision; }

  /// Memory.
  std::size_t bytes() const;

  /// Makes corrections: the points are at `positions` when the vertices of the volume are at `vertices`. If
  /// the strain there is too small to explain the corrections, they are smaller.
  void correctTo(const Points& vertices, const Points& positions);

  /// Writes positions and confidences of the points `which` into their rows of `state`.
  void apply(const MeshState& volume, const std::vector<int>& which, MeshState* state) const;

 private:
  /// An offset of a point, as barycentric coordinates in a tet. They sum to 0.
  struct Correction {
    int tet = -1;
    Eigen::Vector4d barycentric = Eigen::Vector4d::Zero();
  };
  class Corrector;

  std::vector<double> squaredStrains(const Points& vertices) const;
  std::vector<double> strainsOf(const Points& offsets) const;
  std::vector<double> correctionScales(const Points& vertices) const;

  TetTopology volume_;
  std::vector<MaterialPoint> places_;
  std::vector<Correction> corrections_;  ///< per point; empty: no corrections
  std::vector<double> strains_;          ///< per piece, squared, at which the scale is 1
};

}  // namespace softbody
