#pragma once

#include <vector>

#include "elastic/embedded_body.h"
#include "elastic/holders.h"
#include "solid/key_states.h"
#include "solid/pressed_solid.h"

namespace softbody::virtual_camera {

/// A body that a stamp presses harder and harder, along -z of the solver's frame. All is given by the square
/// root of the share of the largest force: so that the first touch of a round body has no vertical tangent.
class PressedStates {
 public:
  /// @param body in the solver's frame. @param pressed not pressed yet. @param holders of the nodes that
  /// `pressed` holds.
  PressedStates(const EmbeddedBody& body, PressedSolid pressed, double largest_n,
                std::vector<Holder> holders = {});

  Points moved(double root) const;  ///< how far each node has moved
  double stampHeight(double root) const;
  ContactForce stamp(double root) const;
  ContactForce table(double root) const;
  std::vector<ContactWrench> onHolders(double root) const;

 private:
  ContactForce forceAt(double root, int first_row) const;

  Eigen::Index nodes_;
  std::vector<Holder> holders_;
  KeyStates states_;
};

/// What the body does to a stamp in its frame. @param T_solver_stamp its frame. @param on_body what the stamp
/// does.
ContactWrench wrenchOn(const std::string& name, const Eigen::Isometry3d& T_solver_stamp,
                       const ContactForce& on_body);

}  // namespace softbody::virtual_camera
