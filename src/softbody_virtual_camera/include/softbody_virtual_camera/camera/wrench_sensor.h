#pragma once

#include <cstdint>
#include <vector>

#include "softbody_virtual_camera/scenes/scene.h"

namespace softbody::virtual_camera {

/// The errors of a force/torque sensor, in its own frame. A torque's error is that of the force times 0.05 m.
struct WrenchSensorOptions {
  bool noise = true;
  double std_n = 0.05;                                  ///< of each force; white
  Eigen::Vector3d bias_n = Eigen::Vector3d::Zero();     ///< constant
  Eigen::Vector3d drift_n_s = Eigen::Vector3d::Zero();  ///< grows with time [N/s]
};

/// Force/torque sensors. The same seed and frame give the same errors; each sensor has its own noise.
class WrenchSensor {
 public:
  WrenchSensor(const WrenchSensorOptions& options, std::uint64_t seed) : options_(options), seed_(seed) {}

  /// @param t time in the scene [s].
  std::vector<ContactWrench> measured(int frame, double t, std::vector<ContactWrench> wrenches) const;

 private:
  WrenchSensorOptions options_;
  std::uint64_t seed_;
};

}  // namespace softbody::virtual_camera
