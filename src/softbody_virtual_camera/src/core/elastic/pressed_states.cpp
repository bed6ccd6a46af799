#include "elastic/pressed_states.h"

#include <Eigen/Dense>
#include <utility>

#include "solid/held_solid.h"

namespace softbody::virtual_camera {
namespace {

/// Rows after the nodes; then force and torque on each holder.
enum PressedRow { kPlace, kForce, kTorque, kTablePlace, kTableForce, kTableTorque, kHeight, kPressedRows };

Points pressedKey(const HexSolid& solid, const PressedShape& shape, const std::vector<Holder>& holders) {
  const Points nodes = asPoints(shape.nodes), forces = asPoints(holdingForces(solid, shape.nodes));
  Points key(nodes.rows() + kPressedRows + 2 * static_cast<Eigen::Index>(holders.size()), 3);
  key.topRows(nodes.rows()) = nodes - solid.grid().nodes;
  Eigen::Index row = nodes.rows();
  for (const ContactForce& contact : {shape.stamp, shape.table}) {
    for (const Eigen::Vector3d& value : {contact.place, contact.force, contact.torque})
      key.row(row++) = value.transpose();
  }
  key.row(row++) << 0.0, 0.0, shape.stamp_m;
  for (const Holder& holder : holders) {
    const ContactWrench wrench = wrenchOn(holder, nodes, forces);
    key.row(row++) = wrench.force.transpose();
    key.row(row++) = wrench.torque.transpose();
  }
  return key;
}

KeyStates statesOf(const HexSolid& solid, PressedSolid pressed, double largest_n,
                   const std::vector<Holder>& holders) {
  constexpr int kIntervals = 10;
  std::vector<Points> keys = {pressedKey(solid, pressed.shape(), holders)};
  for (int key = 1; key <= kIntervals; ++key) {
    const double root = static_cast<double>(key) / kIntervals;
    keys.push_back(pressedKey(solid, pressed.press(largest_n * root * root), holders));
  }
  for (const PressedRow place : {kPlace, kTablePlace}) {
    const Eigen::Index row = solid.grid().nodes.rows() + place;
    keys[0].row(row) = keys[1].row(row);
  }
  return {0.0, 1.0, keys};
}

}  // namespace

PressedStates::PressedStates(const EmbeddedBody& body, PressedSolid pressed, double largest_n,
                             std::vector<Holder> holders)
    : nodes_(body.restNodes().rows()),
      holders_(std::move(holders)),
      states_(statesOf(body.solid(), std::move(pressed), largest_n, holders_)) {}

Points PressedStates::moved(double root) const { return states_.at(root).topRows(nodes_); }

double PressedStates::stampHeight(double root) const { return states_.at(root)(nodes_ + kHeight, 2); }

ContactForce PressedStates::forceAt(double root, int first_row) const {
  const Points rows = states_.at(root).middleRows(nodes_ + first_row, 3);
  return {rows.row(1), rows.row(0), rows.row(2)};
}

ContactForce PressedStates::stamp(double root) const { return forceAt(root, kPlace); }

ContactForce PressedStates::table(double root) const { return forceAt(root, kTablePlace); }

std::vector<ContactWrench> PressedStates::onHolders(double root) const {
  const Points state = states_.at(root);
  std::vector<ContactWrench> wrenches;
  Eigen::Index row = nodes_ + kPressedRows;
  for (const Holder& holder : holders_) {
    wrenches.push_back({holder.name, state.row(row), state.row(row + 1)});
    row += 2;
  }
  return wrenches;
}

ContactWrench wrenchOn(const std::string& name, const Eigen::Isometry3d& T_solver_stamp,
                       const ContactForce& on_body) {
  const Eigen::Matrix3d to_stamp = T_solver_stamp.linear().transpose();
  const Eigen::Vector3d torque = on_body.torque - T_solver_stamp.translation().cross(on_body.force);
  return {name, -(to_stamp * on_body.force), -(to_stamp * torque)};
}

}  // namespace softbody::virtual_camera
