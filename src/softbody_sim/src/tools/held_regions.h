#pragma once

#include <Eigen/Geometry>
#include <map>
#include <string>
#include <vector>

#include "softbody_sim/constraints/surroundings.h"

namespace softbody {

/// A region of the rest shape whose vertices are held, and how they move during a run: a turn about the
/// centre of the region's bounding box, and a shift.
struct HeldRegion {
  std::string region;                               ///< as boxOf() reads it
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();   ///< axis times angle [rad]

  bool moves() const { return !shift.isZero(0.0) || !turn.isZero(0.0); }
};

/// The pins of held regions.
class HeldRegions {
 public:
  /// @param pin_accuracy_m as Pin. @throw std::invalid_argument as verticesWhere does, or if a vertex lies in
  /// two regions that move.
  HeldRegions(const std::vector<HeldRegion>& regions, const Points& rest, double pin_accuracy_m);

  std::size_t size() const { return regions_.size(); }
  const std::string& name(std::size_t region) const { return regions_[region].motion.region; }
  /// @param share of the motions, from 0 to 1. One pin a vertex, in ascending order.
  std::vector<Pin> pinsAt(double share) const;
  /// Upper bound of the way of a pin [m].
  double longestWay() const;
  /// What the body does to each region: the torque is about its centre, where that is now.
  /// @param forces on the pins, in their order.
  std::vector<Wrench> wrenches(const std::vector<Wrench>& forces, double share) const;

 private:
  struct Region {
    HeldRegion motion;
    std::vector<int> vertices;
    Eigen::Vector3d center;  ///< at rest
  };
  void addPins(std::size_t region, const Points& rest, double pin_accuracy_m);

  std::vector<Region> regions_;
  std::map<int, Pin> at_rest_;         ///< by vertex
  std::map<int, std::size_t> moving_;  ///< the region that moves a vertex
};

}  // namespace softbody
