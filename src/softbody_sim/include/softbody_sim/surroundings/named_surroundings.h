#pragma once

#include <string>
#include <vector>

#include "softbody_sim/constraints/surroundings.h"

namespace softbody {

/// Surroundings, and whose they are.
struct NamedSurroundings {
  Surroundings all;
  std::vector<std::string> pins;       ///< per pin: the name of its region
  std::vector<std::string> obstacles;  ///< per obstacle
};

/// What the body does to a pin region or an obstacle.
struct NamedReaction {
  std::string name;
  std::string frame;  ///< that it follows; empty: the frame of the targets
  Wrench wrench;      ///< in that frame, about its origin: what a sensor there would measure
};

/// The same wrench about the origin of its frame. @param place its reference point [m].
inline Wrench aboutOrigin(const Wrench& wrench, const Eigen::Vector3d& place) {
  return {wrench.force, wrench.torque + place.cross(wrench.force)};
}

}  // namespace softbody
