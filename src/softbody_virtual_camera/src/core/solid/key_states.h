#pragma once

#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody::virtual_camera {

/// Points at evenly spaced values of a parameter, with a cubic curve through them (Catmull and Rom 1974).
class KeyStates {
 public:
  /// @param states two or more, at `first` to `last`.
  KeyStates(double first, double last, std::vector<Points> states);

  /// Outside of first to last, the state at that end.
  Points at(double parameter) const;

 private:
  double first_, last_;
  std::vector<Points> states_;  ///< with one more at each end, for its slope
};

}  // namespace softbody::virtual_camera
