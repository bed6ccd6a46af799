#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

#include "softbody_common/types.h"

namespace softbody {

/// Where a body that goes on as it moved will be: constant velocity and spin of the rigid part of each of its
/// connected pieces.
class RigidPrediction {
 public:
  /// @param pieces the vertices of each connected piece.
  RigidPrediction(const Points& rest_vertices, const std::vector<std::vector<int>>& pieces)
      : rest_(rest_vertices), pieces_(pieces) {}

  /// A state of the volume at a stamp; one not after the last starts anew.
  void observe(const Points& vertices, Nanoseconds stamp);

  /// The vertices at a later stamp: as last observed without two states, or long after them.
  /// There must be a state.
  /// @param moving of each piece: false where its velocity is not known, so it is taken to stay; none: all
  /// move.
  Points at(Nanoseconds stamp, const std::vector<bool>& moving = {}) const;

  void reset() { last_.reset(), before_.reset(); }

 private:
  struct Placed {
    Points vertices;
    std::vector<Eigen::Isometry3d> poses;
    Nanoseconds stamp;
  };

  Points rest_;
  std::vector<std::vector<int>> pieces_;  ///< vertices of each
  std::optional<Placed> last_, before_;
};

}  // namespace softbody
