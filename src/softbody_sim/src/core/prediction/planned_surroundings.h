#pragma once

#include <map>
#include <string>
#include <vector>

#include "softbody_sim/prediction/motion_plan.h"

namespace softbody {

/// The surroundings of a plan from step to step.
class PlannedSurroundings {
 public:
  /// @param plan, topology outlive this. @param vertices at present [m].
  PlannedSurroundings(const MotionPlan& plan, const TetTopology& topology, const Points& vertices);

  /// Those of the step from `begin_s` to `end_s`. Regions take hold of `vertices`, the state at its start.
  /// @throw std::invalid_argument if a region that takes hold has no vertex.
  const Surroundings& during(double begin_s, double end_s, const Points& vertices);

  /// Forces by name; torques about the frame's origin. @param reactions of the last step.
  std::map<std::string, Wrench> sumsOf(const Reactions& reactions) const;

  /// Index in the plan of an obstacle of the last step.
  int planned(int obstacle) const {
    return static_cast<int>(active_obstacles_[static_cast<std::size_t>(obstacle)]);
  }
  const std::string& nameOf(int obstacle) const {
    return plan_->obstacles[static_cast<std::size_t>(planned(obstacle))].name;
  }

 private:
  /// A region's pins, from the moment when it takes hold.
  struct Hold {
    bool began = false;
    Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< of what it holds or of the box, at present [m]
    std::vector<Pin> pins;  ///< positions as if they had moved along the path since the present
  };

  void takeHold(const PlannedPins& planned, double time_s, const Points& vertices, Hold* hold) const;

  const MotionPlan* plan_;
  const TetTopology* topology_;
  std::vector<Hold> holds_;  ///< per entry of the plan's pins
  Surroundings surroundings_;
  std::vector<std::size_t> pin_owners_;        ///< per pin: index into the plan's pins
  std::vector<std::size_t> active_obstacles_;  ///< indices into the plan's obstacles
};

}  // namespace softbody
