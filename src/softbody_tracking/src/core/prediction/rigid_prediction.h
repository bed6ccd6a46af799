#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

#include "softbody_common/types.h"

namespace softbody {

/// Predicts the volume's vertices: each piece goes on with the velocity and spin of its rigid motion.
class RigidPrediction {
 public:
  /// @param pieces vertices of each connected piece.
  RigidPrediction(const Points& rest_vertices, const std::vector<std::vector<int>>& pieces)
      : rest_(rest_vertices), pieces_(pieces) {}

  /// Adds a state of the volume. A stamp before the last one discards earlier states.
  void observe(const Points& vertices, Nanoseconds stamp);

  /// The vertices at a later stamp. They stay as last observed if there is only one state, or long after the
  /// last. There must be at least one state.
  /// @param moving of each piece, false if its velocity is unknown: it stays. Empty: all move.
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
