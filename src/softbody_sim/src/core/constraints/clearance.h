#pragma once

#include "softbody_common/geometry/types.h"

namespace softbody {

/// Bounds the distance between parts of a body by how far it has deformed since that distance was measured. A
/// rigid motion brings no parts together.
class Clearance {
 public:
  /// @param reference vertices at the measurement [m]. @param distance_m parts were at least this far apart.
  void set(const Points& reference, double distance_m);
  bool isSet() const { return reference_.rows() > 0; }

  double measured() const { return distance_m_; }

  /// Lower bound of the distance for the vertices x [m].
  double at(const Points& x) const;

 private:
  Points reference_;
  double distance_m_ = 0.0;
};

}  // namespace softbody
