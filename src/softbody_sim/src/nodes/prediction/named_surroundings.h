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

}  // namespace softbody
