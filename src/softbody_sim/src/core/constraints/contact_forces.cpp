#include "constraints/contact_forces.h"

#include <algorithm>
#include <cmath>

#include "softbody_common/tet_geometry.h"

namespace softbody {

ContactForces::ContactForces(const TetTopology& topology, double spacing_m, double pressure_stiffness,
                             double reach_m)
    : topology_(&topology),
      spacing_m_(spacing_m),
      pressure_stiffness_(pressure_stiffness),
      reach_m_(reach_m) {}

void ContactForces::find(const Points& before, const Points& now, const std::vector<Obstacle>& obstacles,
                         const std::vector<Eigen::Isometry3d>& before_poses, std::vector<Contact>* contacts) {
  if (!obstacles.empty() && points_.empty()) points_ = sampleContactPoints(*topology_, spacing_m_);
  findContacts(points_, topology_->tets, before, now, obstacles, before_poses, reach_m_, contacts);
}

void ContactForces::addSprings(const std::vector<Contact>& contacts, TargetEnergy* springs) const {
  for (const Contact& contact : contacts) {
    const ContactPoint& point = points_[static_cast<std::size_t>(contact.point)];
    const double stiffness = stiffnessOf(contact);
    springs->addOneSided(point.place, topology_->tets, contact.position, contact.normal, stiffness);
    if (contact.friction > 0.0)
      springs->addFriction(point.place, topology_->tets, contact.anchor, contact.normal, stiffness,
                           contact.friction * stiffness * contact.depth);
  }
}

bool ContactForces::updateFriction(const Points& x, std::vector<Contact>* contacts) const {
  constexpr double kNoticeable = 0.01;
  double total = 0.0, change = 0.0;
  for (Contact& contact : *contacts) {
    if (contact.friction == 0.0) continue;
    const double depth = depthOf(contact, x);
    total += stiffnessOf(contact) * depth;
    change += stiffnessOf(contact) * std::abs(depth - contact.depth);
    contact.depth = depth;
  }
  return change > kNoticeable * total;
}

double ContactForces::stiffnessOf(const Contact& contact) const {
  return pressure_stiffness_ * points_[static_cast<std::size_t>(contact.point)].area;
}

/// The force on the body.
Eigen::Vector3d ContactForces::frictionOf(const Contact& contact, const Points& x) const {
  const ContactPoint& point = points_[static_cast<std::size_t>(contact.point)];
  Eigen::Vector3d offset = positionOf(point.place, x, topology_->tets) - contact.anchor;
  offset -= contact.normal.dot(offset) * contact.normal;
  const double slide = contact.friction * contact.depth, length = offset.norm();
  return -stiffnessOf(contact) * (length > slide ? slide / length : 1.0) * offset;
}

double ContactForces::depthOf(const Contact& contact, const Points& x) const {
  const ContactPoint& point = points_[static_cast<std::size_t>(contact.point)];
  return std::max(0.0, contact.normal.dot(contact.position - positionOf(point.place, x, topology_->tets)));
}

double ContactForces::largestDepthChange(const std::vector<Contact>& a, const std::vector<Contact>& b,
                                         const Points& x) const {
  double largest = 0.0;
  auto i = a.begin(), j = b.begin();
  while (i != a.end() || j != b.end()) {
    double change = 0.0;
    const bool takes_a = j == b.end() || (i != a.end() && !isOrderedBefore(*j, *i));
    const bool takes_b = i == a.end() || (j != b.end() && !isOrderedBefore(*i, *j));
    if (takes_a) change += depthOf(*i++, x);
    if (takes_b) change -= depthOf(*j++, x);
    largest = std::max(largest, std::abs(change));
  }
  return largest;
}

void ContactForces::wrenches(const std::vector<Contact>& contacts, const Points& x,
                             const std::vector<Obstacle>& obstacles, std::vector<Wrench>* wrenches) const {
  wrenches->assign(obstacles.size(), Wrench());
  for (const Contact& contact : contacts) {
    const ContactPoint& point = points_[static_cast<std::size_t>(contact.point)];
    const auto obstacle = static_cast<std::size_t>(contact.obstacle);
    Eigen::Vector3d force = -pressure_stiffness_ * point.area * depthOf(contact, x) * contact.normal;
    if (contact.friction > 0.0) force -= frictionOf(contact, x);
    const Eigen::Vector3d arm =
        positionOf(point.place, x, topology_->tets) - obstacles[obstacle].pose.translation();
    (*wrenches)[obstacle].force += force;
    (*wrenches)[obstacle].torque += arm.cross(force);
  }
}

}  // namespace softbody
