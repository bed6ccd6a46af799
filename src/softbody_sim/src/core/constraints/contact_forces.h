#pragma once

#include <optional>
#include <vector>

#include "constraints/contact_detection.h"
#include "constraints/contact_patches.h"
#include "constraints/self_contact.h"
#include "constraints/target_energy.h"
#include "softbody_sim/constraints/surroundings.h"

namespace softbody {

/// Contact by one-sided springs: a depth d gives the pressure k d. The planes are lifted until the points lie
/// on the obstacle itself (augmented Lagrangian, Hestenes 1969); the next step starts with these lifts.
/// Friction obeys Coulomb's law: a point sticks to the obstacle up to the coefficient times the force of its
/// contact, then it slides. Sticking is a spring too; its anchor stays from step to step (Cundall and Strack
/// 1979). A contact of the body with itself acts between two of its points.
class ContactForces {
 public:
  /// @param topology outlives this; @param pressure_stiffness k [Pa/m]; @param reach_m larger distances are
  /// no contact; @param largest_lift_m limits the force of a contact that cannot be kept.
  ContactForces(const TetTopology& topology, double spacing_m, double pressure_stiffness, double reach_m,
                double largest_lift_m);

  /// From now on, the body touches itself.
  void addSelfContact(const SelfContact::Options& options) { self_contact_.emplace(*topology_, options); }

  /// Forgets what a simulation from other shapes has left.
  void restart();

  /// Begins a step at the vertices `before`. The first call in which something can touch creates the contact
  /// points. @param touches_itself whether contact of the body with itself counts, if it was added.
  void start(const Points& before, const std::vector<Obstacle>& obstacles, bool touches_itself);

  /// Finds the contacts of a step.
  /// @param before, now as in findContacts; @param state of the last step.
  void find(const Points& before, const Points& now, const std::vector<Obstacle>& obstacles,
            const ContactState& state, std::vector<Contact>* contacts);

  void addSprings(const std::vector<Contact>& contacts, TargetEnergy* springs) const;

  /// Friction from the depths at x from now on. @return whether that changes the forces on the vertices
  /// noticeably. Where points are close together, force may move between them for long without effect.
  /// @param unnoticed_n a sum of changes that is too small in any case [N].
  bool updateFriction(const Points& x, double unnoticed_n, std::vector<Contact>* contacts);

  /// Friction from the depths at x, of contacts that have just been found.
  void takeDepths(const Points& x, std::vector<Contact>* contacts) const;

  /// Lifts that give the forces at x with the points on the obstacle. @return the largest change [m].
  double updateLifts(const Points& x, std::vector<Contact>* contacts) const;

  /// Keeps of the contacts at the end of a step what the next step needs. @param balanced whether the forces
  /// at x are.
  void remember(const Points& x, const std::vector<Obstacle>& obstacles, bool balanced,
                std::vector<Contact>* contacts) const;

  /// Largest difference between two lists in a point's penetration depth [m]. Both are ordered as by
  /// findContacts.
  double largestDepthChange(const std::vector<Contact>& a, const std::vector<Contact>& b,
                            const Points& x) const;

  /// The body's force and torque on each obstacle. @param remembered as remember() leaves them at x.
  void wrenches(const std::vector<Contact>& remembered, const Points& x,
                const std::vector<Obstacle>& obstacles, std::vector<Wrench>* wrenches) const;

  /// The body's forces on the obstacles, where there are any. @param state at the vertices x [m].
  std::vector<PointForce> pointForces(const ContactState& state, const Points& x);

 private:
  void createPoints();
  /// The body's force on an obstacle. @param contact as remember() leaves it at x. @param pose of the
  /// obstacle.
  PointForce forceOf(const Contact& contact, const Eigen::Isometry3d& pose, const Points& x) const;
  Eigen::Vector3d placeOf(const Contact& contact, const Points& x) const;
  double depthOf(const Contact& contact, const Points& x) const;
  double stiffnessOf(const Contact& contact) const;
  Eigen::Vector3d slipOf(const Contact& contact, const Points& x) const;
  Eigen::Vector3d frictionOf(const Contact& contact, const Points& x) const;

  const TetTopology* topology_;
  std::optional<SelfContact> self_contact_;
  bool touches_itself_ = false;  ///< in this step
  std::vector<ContactPoint> points_;
  Points friction_change_;  ///< on the vertices [N]
  double spacing_m_, pressure_stiffness_, reach_m_, largest_lift_m_;
};

}  // namespace softbody
