#include "softbody_sim/surroundings/named_surroundings.h"

namespace softbody {

Wrench aboutOrigin(const Wrench& wrench, const Eigen::Vector3d& place) {
  return {wrench.force, wrench.torque + place.cross(wrench.force)};
}

}  // namespace softbody
