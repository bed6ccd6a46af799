#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <map>
#include <optional>
#include <vector>

#include "prediction/tracking_signal.h"
#include "softbody_common/geometry/types.h"

namespace softbody {

/// Which share of a rigid motion is known: maps (spin, velocity of the centre) to the known part of it.
using MotionShare = Eigen::Matrix<double, 6, 6>;

/// Predicts the volume's vertices: each piece continues with the velocity and spin of its rigid motion.
/// Velocity and spin are averaged the more, the better the predictions are (see TrackingSignal).
class RigidPrediction {
 public:
  /// @param pieces vertices of each connected piece.
  RigidPrediction(const Points& rest_vertices, const std::vector<std::vector<int>>& pieces)
      : rest_(rest_vertices), pieces_(pieces) {}

  /// Adds a state of the volume. A stamp before the last one discards earlier states.
  void observe(const Points& vertices, Nanoseconds stamp);

  /// The vertices at a later stamp. If there is only one state, or if the last state is too old, they stay as
  /// last observed. There must be at least one state.
  /// @param known for each piece; a motion that is unknown is assumed to be none. Empty: all is known.
  Points at(Nanoseconds stamp, const std::vector<MotionShare>& known = {});

  void reset();

 private:
  struct Placed {
    Points vertices;
    std::vector<Eigen::Isometry3d> poses;
    Nanoseconds stamp;
  };
  /// Velocity of a piece's centre [m/s], and its spin [rad/s].
  struct Velocity {
    Eigen::Vector3d linear = Eigen::Vector3d::Zero(), angular = Eigen::Vector3d::Zero();

    Velocity knownPart(const MotionShare& share) const;
  };

  Eigen::Vector3d restCenter(std::size_t piece) const;
  Placed placed(const Points& vertices, Nanoseconds stamp) const;
  Points corrections(const std::vector<Eigen::Isometry3d>& predicted, const Placed& now) const;
  void updateVelocities(const Placed& now);
  double gainOf(const std::vector<int>& piece) const;

  Points rest_;
  std::vector<std::vector<int>> pieces_;  ///< vertices of each
  std::optional<Placed> last_;
  double interval_s_ = 0.0;           ///< between the last two states; 0: there is one state
  std::vector<Velocity> velocities_;  ///< of each piece
  std::map<Nanoseconds, std::vector<Eigen::Isometry3d>> predicted_;  ///< poses not yet compared with a state
  TrackingSignal signal_;
};

}  // namespace softbody
