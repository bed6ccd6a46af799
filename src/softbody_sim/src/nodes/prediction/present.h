#pragma once

#include <std_msgs/Header.h>

#include <map>
#include <memory>
#include <string>

#include "softbody_sim/dynamics/simulator.h"
#include "softbody_sim/surroundings/body_surface.h"
#include "softbody_sim/surroundings/named_surroundings.h"

namespace softbody {

/// The present, to predict from.
struct Present {
  std::unique_ptr<Simulator> simulator;
  NamedSurroundings surroundings;
  double pin_accuracy_m = 0.0;
  std::shared_ptr<const BodySurface> surface;  ///< in the tets of the simulator
  std_msgs::Header header;
  std::map<std::string, Eigen::Isometry3d> frames;  ///< poses of those that the plans name and tf knows
};

}  // namespace softbody
