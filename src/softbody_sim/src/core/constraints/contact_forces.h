#pragma once

#include <vector>

#include "constraints/contact_detection.h"
#include "constraints/target_energy.h"
#include "softbody_sim/constraints/surroundings.h"

namespace softbody {

/// Contact by one-sided springs: a penetration depth d gives the pressure k d. Friction obeys Coulomb's law:
/// a point sticks to the obstacle up to the coefficient times the force of its contact, then it slides.
/// Sticking is a spring too, to the point's place at the start of the step.
class ContactForces {
 public:
  /// @param topology outlives this; @param pressure_stiffness k [Pa/m]; @param reach_m larger distances are
  /// no contact.
  ContactForces(const TetTopology& topology, double spacing_m, double pressure_stiffness, double reach_m);

  /// Finds the contacts of a step. The first call with obstacles creates the contact points.
  /// @param before, now, before_poses as in findContacts.
  void find(const Points& before, const Points& now, const std::vector<Obstacle>& obstacles,
            const std::vector<Eigen::Isometry3d>& before_poses, std::vector<Contact>* contacts);

  void addSprings(const std::vector<Contact>& contacts, TargetEnergy* springs) const;

  /// Friction from the depths at x from now on. @return whether the forces of friction change noticeably.
  bool updateFriction(const Points& x, std::vector<Contact>* contacts) const;

  /// Largest difference between two lists in a point's penetration depth [m]. Both are ordered as by
  /// findContacts.
  double largestDepthChange(const std::vector<Contact>& a, const std::vector<Contact>& b,
                            const Points& x) const;

  /// The body's force and torque on each obstacle.
  void wrenches(const std::vector<Contact>& contacts, const Points& x, const std::vector<Obstacle>& obstacles,
                std::vector<Wrench>* wrenches) const;

 private:
  double depthOf(const Contact& contact, const Points& x) const;
  double stiffnessOf(const Contact& contact) const;
  Eigen::Vector3d frictionOf(const Contact& contact, const Points& x) const;

  const TetTopology* topology_;
  std::vector<ContactPoint> points_;
  double spacing_m_, pressure_stiffness_, reach_m_;
};

}  // namespace softbody
