#pragma once

#include <Eigen/Core>
#include <vector>

#include "softbody_common/types.h"

namespace softbody {

/// Points that follow tets. At rest each is at its place; a correction can make them meet given positions in
/// one deformed state. A correction is kept in the material of the point's tet, so that it turns and
/// stretches with it, or of a neighbouring one where that is too flat to hold it; and is scaled by the strain
/// of the tet's piece over that in the state that it was made for: to nothing at rest, never above what it
/// was made with.
class TetBinding {
 public:
  TetBinding(const TetTopology& volume, std::vector<MaterialPoint> places);

  const TetTopology& volume() const { return volume_; }
  const std::vector<MaterialPoint>& places() const { return places_; }
  void setRevision(std::uint32_t revision) { volume_.revision = revision; }

  /// Corrects the points so that they are at `positions` when the volume's vertices are at `vertices`.
  void meet(const Points& vertices, const Points& positions);

  /// Positions and confidences of the points named by `which`, into their rows of `state`.
  void apply(const MeshState& volume, const std::vector<int>& which, MeshState* state) const;

 private:
  /// To be added to a point's position: the barycentric coordinates in a tet, which sum to 0.
  struct Correction {
    int tet = -1;
    Eigen::Vector4d barycentric = Eigen::Vector4d::Zero();
  };
  class Meeting;

  std::vector<double> squaredStrains(const Points& vertices) const;
  std::vector<double> correctionScales(const Points& vertices) const;

  TetTopology volume_;
  std::vector<MaterialPoint> places_;
  std::vector<Correction> corrections_;  ///< per point, or none
  std::vector<double> strains_;          ///< per piece, squared, in the state that was met
};

}  // namespace softbody
