#pragma once

#include <vector>

#include "softbody_common/geometry/types.h"
#include "softbody_sim/constraints/surroundings.h"

namespace softbody {

/// The body's forces on its pins without the springs of the targets. An estimate takes as long as many steps,
/// so it is made a few times a second, as in the simulator node.
class PinForces {
 public:
  /// Whether pins act, and the last estimate is too old or of other vertices.
  bool areDue(const std::vector<Pin>& pins, Nanoseconds stamp) const;
  /// A new estimate.
  void set(const std::vector<Pin>& pins, Nanoseconds stamp, std::vector<Wrench> forces);
  /// Replaces the forces of a step by the last estimate, if it is of the same number of pins.
  void applyTo(std::vector<Wrench>* pins) const;

 private:
  Nanoseconds stamp_ = 0;
  std::vector<int> held_;  ///< vertices
  std::vector<Wrench> forces_;
};

}  // namespace softbody
