#pragma once

#include <Eigen/Geometry>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "softbody_sim/constraints/surroundings.h"
#include "softbody_sim/object/pin_region.h"
#include "softbody_sim/surroundings/body_surface.h"

namespace softbody {

/// A rigid motion over time, in the frame of the targets. It starts with the identity at time 0.
struct RigidPath {
  std::vector<double> times_s;  ///< ascending, above 0
  std::vector<Eigen::Isometry3d> motions;

  /// Between two times the turn is about a centre, which moves on a straight line. The last motion stays. The
  /// identity without times. @param center of what moves, at time 0 [m].
  Eigen::Isometry3d at(double time_s, const Eigen::Vector3d& center) const;
};

/// Times that differ by less are equal [s].
constexpr double kTimeRounding_s = 1e-9;

/// When something acts [s from the present]: in the steps that end after `begin`, up to `end`.
struct ActivePeriod {
  double begin_s = 0.0, end_s = std::numeric_limits<double>::infinity();

  bool contains(double time_s) const;
  /// Whether a step ends in it. The steps begin at the present.
  bool holdsStep(double time_step_s) const;
};

/// The pins of one name in a plan: those that hold at present, or a region that takes hold at the beginning
/// of its period.
struct PlannedPins {
  std::string name;
  std::vector<Pin> held;                                    ///< at present, if there is no region
  std::optional<PinRegion> region;                          ///< its box is in rest space or in `frame`
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();  ///< of the box, at present
  double accuracy_m = 0.0;                                  ///< of a region's pins
  RigidPath path = {};                                      ///< of the box and of what it holds
  ActivePeriod period = {};
};

struct PlannedObstacle {
  std::string name;
  Obstacle shape;         ///< at present
  bool acts_now = false;  ///< it is an obstacle of the present step; those come first, in its order
  RigidPath path = {};
  ActivePeriod period = {};
};

/// What a prediction assumes about the surroundings.
struct MotionPlan {
  std::vector<PlannedPins> pins;
  std::vector<PlannedObstacle> obstacles;
  std::shared_ptr<const BodySurface> surface = std::make_shared<BodySurface>();  ///< in the present tets
};

}  // namespace softbody
