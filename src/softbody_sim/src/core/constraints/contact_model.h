#pragma once

#include <vector>

#include "constraints/contact.h"
#include "constraints/target_energy.h"
#include "softbody_sim/constraints/surroundings.h"

namespace softbody {

/// Contact without friction as one-sided springs: a point that is in by d feels the pressure k d.
class ContactModel {
 public:
  /// @param topology outlives this; @param pressure_stiffness k [Pa/m]; @param reach_m contacts that are
  /// farther apart are left out.
  ContactModel(const TetTopology& topology, double spacing_m, double pressure_stiffness, double reach_m);

  /// The contacts of a step from `before`, as its vertices are now. The first obstacles make the contact
  /// points. @param before_poses as in findContacts.
  void find(const Points& before, const Points& now, const std::vector<Obstacle>& obstacles,
            const std::vector<Eigen::Isometry3d>& before_poses, std::vector<Contact>* contacts);

  void addSprings(const std::vector<Contact>& contacts, TargetEnergy* springs) const;

  /// Largest change between two lists in how deep a point is in its obstacle [m]: how far one is from
  /// describing contact as the other does. Both as findContacts orders them.
  double largestDepthChange(const std::vector<Contact>& a, const std::vector<Contact>& b,
                            const Points& x) const;

  /// What the body does to each obstacle.
  void wrenches(const std::vector<Contact>& contacts, const Points& x, const std::vector<Obstacle>& obstacles,
                std::vector<Wrench>* wrenches) const;

 private:
  double depthOf(const Contact& contact, const Points& x) const;

  const TetTopology* topology_;
  std::vector<ContactPoint> points_;
  double spacing_m_, pressure_stiffness_, reach_m_;
};

}  // namespace softbody
