#pragma once

#include <string>
#include <vector>

#include "softbody_common/geometry/types.h"
#include "softbody_sim/surroundings/named_surroundings.h"

namespace softbody {

/// What a recording shows of a body in one image. All in the fixed frame.
struct SeenFrame {
  Nanoseconds stamp = 0;
  std::vector<Target> targets;  ///< measured places of the uncut body
  Points vertices;              ///< where the tracker sees the volume's vertices [m]
  NamedSurroundings around;
};

/// A measured wrench at a pin region or an obstacle.
struct WrenchSample {
  Nanoseconds stamp = 0;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< of the torque [m]
  Wrench value;                                      ///< of the body, in the fixed frame
};

/// All that one sensor, or a known weight, says.
struct WrenchRecord {
  std::string at;                     ///< name of a pin region or an obstacle
  std::string source;                 ///< topic, or what is known, for messages
  double least_std_n = 0.0;           ///< of each component of the force, even of a mean of many samples
  std::vector<WrenchSample> samples;  ///< by stamp; a weight has one, which always acts
  bool always = false;
};

}  // namespace softbody
