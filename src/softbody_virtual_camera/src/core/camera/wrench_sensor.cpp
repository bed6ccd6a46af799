#include "softbody_virtual_camera/camera/wrench_sensor.h"

#include <cmath>

#include "softbody_common/statistics/random.h"

namespace softbody::virtual_camera {
namespace {

constexpr double kLever_m = 0.05;  // torque error over force error

/// Standard normal (Box and Muller 1958).
double normal(std::uint64_t seed) {
  return std::sqrt(-2.0 * std::log(1.0 - unit(hash(seed, 1)))) *
         std::cos(2.0 * 3.14159265358979323846 * unit(hash(seed, 2)));
}

}  // namespace

std::vector<ContactWrench> WrenchSensor::measured(int frame, double t,
                                                  std::vector<ContactWrench> wrenches) const {
  const Eigen::Vector3d slow = options_.bias_n + t * options_.drift_n_s;
  std::uint64_t number = hash(seed_, static_cast<std::uint64_t>(frame));
  for (ContactWrench& wrench : wrenches) {
    for (const auto& [value, lever] : {std::pair(&wrench.force, 1.0), std::pair(&wrench.torque, kLever_m)}) {
      *value += lever * slow;
      if (!options_.noise) continue;
      for (int axis = 0; axis < 3; ++axis)
        (*value)[axis] += lever * options_.std_n * normal(number = hash(number));
    }
  }
  return wrenches;
}

}  // namespace softbody::virtual_camera
