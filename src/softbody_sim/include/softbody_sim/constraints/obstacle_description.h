#pragma once

#include <string>
#include <vector>

#include "softbody_common/parameters/parameters.h"
#include "softbody_sim/constraints/obstacle.h"

namespace softbody {

/// An obstacle as the parameters describe it.
struct ObstacleDescription {
  std::string name;   ///< of its reaction's topic
  std::string frame;  ///< the frame that it follows; empty: the targets' frame
  Obstacle shape;     ///< its pose is in that frame
};

/// One obstacle: a map with name, frame, shape (plane, sphere, capsule or box), pose, friction, and the
/// sizes of its shape (radius_m, length_m, size_m, rounding_m).
/// @throw std::invalid_argument with key, value and allowed values.
ObstacleDescription readObstacle(Parameters& map);

/// The parameter `obstacles`: a list of such maps.
/// @param unknown receives unknown keys.
/// @throw std::invalid_argument with key, value and allowed values.
std::vector<ObstacleDescription> readObstacles(Parameters& parameters, std::vector<std::string>* unknown);

/// @throw std::invalid_argument if a name cannot be part of a topic name.
void requireTopicName(const std::string& name);

}  // namespace softbody
