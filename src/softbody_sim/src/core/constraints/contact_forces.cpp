#include "constraints/contact_forces.h"

#include <algorithm>
#include <cmath>

#include "softbody_common/geometry/tet_geometry.h"

namespace softbody {

namespace {

/// Of the frame of a contact's slip.
Eigen::Matrix3d orientationOf(const Contact& contact, const std::vector<Obstacle>& obstacles) {
  if (contact.isWithBody()) return Eigen::Matrix3d::Identity();
  return obstacles[static_cast<std::size_t>(contact.obstacle)].pose.linear();
}

void addForce(const Eigen::Vector3d& force, const MaterialPoint& place, const Tets& tets, Points* forces) {
  for (int k = 0; k < 4; ++k) forces->row(tets(place.tet, k)) += place.barycentric[k] * force.transpose();
}

}  // namespace

ContactForces::ContactForces(const TetTopology& topology, double spacing_m, double pressure_stiffness,
                             double reach_m, double largest_lift_m)
    : topology_(&topology),
      spacing_m_(spacing_m),
      pressure_stiffness_(pressure_stiffness),
      reach_m_(reach_m),
      largest_lift_m_(largest_lift_m) {}

void ContactForces::restart() {
  if (self_contact_) self_contact_->restart();
}

void ContactForces::createPoints() {
  if (points_.empty()) points_ = sampleContactPoints(*topology_, spacing_m_);
}

void ContactForces::start(const Points& before, const std::vector<Obstacle>& obstacles, bool touches_itself) {
  touches_itself_ = touches_itself && self_contact_;
  if (!obstacles.empty() || touches_itself_) createPoints();
  if (touches_itself_) self_contact_->start(points_, before);
}

void ContactForces::find(const Points& before, const Points& now, const std::vector<Obstacle>& obstacles,
                         const ContactState& state, std::vector<Contact>* contacts) {
  const bool touches_itself = touches_itself_ && self_contact_->mayTouch(before, now);
  findContacts(points_, topology_->tets, before, now, obstacles, state.obstacle_poses, reach_m_, contacts);
  if (touches_itself) self_contact_->find(points_, before, now, contacts);
  auto earlier = state.contacts.begin();
  for (Contact& contact : *contacts) {
    while (earlier != state.contacts.end() && isOrderedBefore(*earlier, contact)) ++earlier;
    if (earlier == state.contacts.end() || isOrderedBefore(contact, *earlier)) continue;
    contact.lift = earlier->lift;
    contact.depth += earlier->lift;
    const Eigen::Vector3d slip = orientationOf(contact, obstacles) * earlier->slip;
    contact.anchor -= slip - contact.normal.dot(slip) * contact.normal;
  }
}

void ContactForces::addSprings(const std::vector<Contact>& contacts, TargetEnergy* springs) const {
  for (const Contact& contact : contacts) {
    const ContactPoint& point = points_[static_cast<std::size_t>(contact.point)];
    const double stiffness = stiffnessOf(contact);
    springs->addOneSided(point.place, topology_->tets, contact.position + contact.lift * contact.normal,
                         contact.normal, stiffness);
    if (contact.isWithBody()) springs->coupleLast(contact.other, topology_->tets);
    if (contact.friction == 0.0) continue;
    springs->addFriction(point.place, topology_->tets, contact.anchor, contact.normal, stiffness,
                         contact.friction * stiffness * contact.depth);
    if (contact.isWithBody()) springs->coupleLast(contact.other, topology_->tets);
  }
}

bool ContactForces::updateFriction(const Points& x, double unnoticed_n, std::vector<Contact>* contacts) {
  constexpr double kNoticeable = 0.01;  // of the contact force: friction is not known better
  if (contacts->empty()) return false;
  double total = 0.0;
  friction_change_.setZero(x.rows(), 3);
  for (Contact& contact : *contacts) {
    if (contact.friction == 0.0) continue;
    const double depth = depthOf(contact, x);
    total += stiffnessOf(contact) * depth;
    const Eigen::Vector3d before = frictionOf(contact, x);
    contact.depth = depth;
    const Eigen::Vector3d change = frictionOf(contact, x) - before;
    addForce(change, points_[static_cast<std::size_t>(contact.point)].place, topology_->tets,
             &friction_change_);
    if (contact.isWithBody()) addForce(-change, contact.other, topology_->tets, &friction_change_);
  }
  return friction_change_.rowwise().norm().sum() > std::max(kNoticeable * total, unnoticed_n);
}

void ContactForces::takeDepths(const Points& x, std::vector<Contact>* contacts) const {
  for (Contact& contact : *contacts) contact.depth = depthOf(contact, x);
}

double ContactForces::updateLifts(const Points& x, std::vector<Contact>* contacts) const {
  double largest = 0.0;
  for (Contact& contact : *contacts) {
    const double lift = std::min(depthOf(contact, x), largest_lift_m_);
    // A lift above a point that the contact does not reach gives no force.
    if (lift > 0.0) largest = std::max(largest, std::abs(lift - contact.lift));
    contact.lift = lift;
  }
  return largest;
}

void ContactForces::remember(const Points& x, const std::vector<Obstacle>& obstacles, bool balanced,
                             std::vector<Contact>* contacts) const {
  for (Contact& contact : *contacts) {
    contact.slip = orientationOf(contact, obstacles).transpose() * slipOf(contact, x);
    contact.depth = depthOf(contact, x);
  }
  if (balanced) updateLifts(x, contacts);
  const auto pushes_not = [](const Contact& contact) { return contact.depth == 0.0; };
  contacts->erase(std::remove_if(contacts->begin(), contacts->end(), pushes_not), contacts->end());
}

double ContactForces::stiffnessOf(const Contact& contact) const {
  return pressure_stiffness_ * points_[static_cast<std::size_t>(contact.point)].area;
}

/// Of the point from its anchor, as far as friction holds it [m].
Eigen::Vector3d ContactForces::slipOf(const Contact& contact, const Points& x) const {
  Eigen::Vector3d offset = placeOf(contact, x) - contact.anchor;
  offset -= contact.normal.dot(offset) * contact.normal;
  const double slide = contact.friction * contact.depth, length = offset.norm();
  return (length > slide ? slide / length : 1.0) * offset;
}

/// The force on the body.
Eigen::Vector3d ContactForces::frictionOf(const Contact& contact, const Points& x) const {
  return -stiffnessOf(contact) * slipOf(contact, x);
}

/// Of the point, relative to what position and anchor are relative to.
Eigen::Vector3d ContactForces::placeOf(const Contact& contact, const Points& x) const {
  const MaterialPoint& own = points_[static_cast<std::size_t>(contact.point)].place;
  const Eigen::Vector3d place = positionOf(own, x, topology_->tets);
  if (!contact.isWithBody()) return place;
  return place - positionOf(contact.other, x, topology_->tets);
}

double ContactForces::depthOf(const Contact& contact, const Points& x) const {
  return std::max(0.0, contact.lift + contact.normal.dot(contact.position - placeOf(contact, x)));
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

PointForce ContactForces::forceOf(const Contact& contact, const Eigen::Isometry3d& pose,
                                  const Points& x) const {
  const MaterialPoint& place = points_[static_cast<std::size_t>(contact.point)].place;
  const Eigen::Vector3d offset = contact.depth * contact.normal - pose.linear() * contact.slip;
  return {place, contact.obstacle, positionOf(place, x, topology_->tets), contact.normal,
          -stiffnessOf(contact) * offset};
}

void ContactForces::wrenches(const std::vector<Contact>& remembered, const Points& x,
                             const std::vector<Obstacle>& obstacles, std::vector<Wrench>* wrenches) const {
  wrenches->assign(obstacles.size(), Wrench());
  for (const Contact& contact : remembered) {
    if (contact.isWithBody()) continue;
    const auto obstacle = static_cast<std::size_t>(contact.obstacle);
    const Eigen::Isometry3d& pose = obstacles[obstacle].pose;
    const PointForce point = forceOf(contact, pose, x);
    (*wrenches)[obstacle].force += point.force;
    (*wrenches)[obstacle].torque += (point.position - pose.translation()).cross(point.force);
  }
}

std::vector<PointForce> ContactForces::pointForces(const ContactState& state, const Points& x) {
  createPoints();
  std::vector<PointForce> forces;
  for (const Contact& contact : state.contacts) {
    if (contact.isWithBody()) continue;
    forces.push_back(forceOf(contact, state.obstacle_poses[static_cast<std::size_t>(contact.obstacle)], x));
  }
  return forces;
}

}  // namespace softbody
