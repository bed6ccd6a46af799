#include "tools/held_regions.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "softbody_common/geometry/rigid_motion.h"
#include "softbody_sim/object/vertex_region.h"

namespace softbody {
HeldRegions::HeldRegions(const std::vector<HeldRegion>& regions, const Points& rest, double pin_accuracy_m) {
  for (const HeldRegion& held : regions) {
    Region region{held, verticesWhere(held.region, rest), {}};
    Eigen::AlignedBox3d box;
    for (const int v : region.vertices) box.extend(Eigen::Vector3d(rest.row(v)));
    region.center = box.center();
    regions_.push_back(region);
    addPins(regions_.size() - 1, rest, pin_accuracy_m);
  }
}

void HeldRegions::addPins(std::size_t r, const Points& rest, double pin_accuracy_m) {
  for (const int v : regions_[r].vertices) {
    at_rest_[v] = {v, rest.row(v), pin_accuracy_m};
    if (!regions_[r].motion.moves()) continue;
    const auto [other, is_first] = moving_.emplace(v, r);
    if (is_first) continue;
    throw std::invalid_argument(
        fmt::format("vertex {} lies in two regions that move, '{}' and '{}'; each vertex can make one motion",
                    v, name(other->second), name(r)));
  }
}

std::vector<Pin> HeldRegions::pinsAt(double share) const {
  std::vector<Pin> pins;
  for (auto [vertex, pin] : at_rest_) {
    const auto mover = moving_.find(vertex);
    if (mover != moving_.end()) {
      const Region& region = regions_[mover->second];
      pin.position = region.center + share * region.motion.shift +
                     rotationBy(share * region.motion.turn) * (pin.position - region.center);
    }
    pins.push_back(pin);
  }
  return pins;
}

double HeldRegions::longestWay() const {
  double longest = 0.0;
  for (const auto& [vertex, r] : moving_) {
    const Region& region = regions_[r];
    const double radius = (at_rest_.at(vertex).position - region.center).norm();
    longest = std::max(longest, region.motion.shift.norm() + region.motion.turn.norm() * radius);
  }
  return longest;
}

std::vector<Wrench> HeldRegions::wrenches(const std::vector<Wrench>& forces, double share) const {
  const std::vector<Pin> pins = pinsAt(share);
  std::vector<Wrench> wrenches;
  for (const Region& region : regions_) {
    Wrench sum;
    const Eigen::Vector3d center = region.center + share * region.motion.shift;
    for (std::size_t k = 0; k < pins.size(); ++k) {
      if (!std::binary_search(region.vertices.begin(), region.vertices.end(), pins[k].vertex)) continue;
      sum.force += forces[k].force;
      sum.torque += (pins[k].position - center).cross(forces[k].force);
    }
    wrenches.push_back(sum);
  }
  return wrenches;
}

}  // namespace softbody
