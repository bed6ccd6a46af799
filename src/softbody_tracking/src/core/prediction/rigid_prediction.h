#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

#include "softbody_common/types.h"

namespace softbody {

/// Predicts the volume's vertices: each piece continues with the velocity and spin of its rigid motion.
class RigidPrediction {
 public:
  /// @param pieces vertices of each connected piece.
  RigidPrediction(const Points& rest_vertices, const std::vector<std::vector<int>>& pieces)
      : rest_(rest_vertices), pieces_(pieces) {}

  /// Adds a state of the volume. A stamp before the last one discards earlier states.
  void observe(const Points& vertices, Nanoseconds stamp);

  /// The vertices at a later stamp. If there is only one state, or if the last state is too old, they stay as
  /// last observed. There must be at least one state.
  /// @param moving for each piece; false: its velocity is unknown, so it stays. Empty: all move.
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
