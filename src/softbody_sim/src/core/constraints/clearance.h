#pragma once

#include "softbody_common/types.h"

namespace softbody {

/// Bounds the distance between parts of a body by how far it has deformed since that distance was measured. A
/// rigid motion brings no parts together.
class Clearance {
 public:
  /// @param reference vertices at the measurement [m]. @param distance_m parts were at least this far apart.
  void set(const Points& reference, double distance_m);
  bool isSet() const { return reference_.rows() > 0; }

  /// Begins a step at the vertices `before`.
  void start(const Points& before);
  double measured() const { return distance_m_; }
  /// Lower bound of the distance at the start of the step [m].
  double atStart() const { return distance_m_ - 2.0 * deviation_m_; }
  /// The same for all shapes on the straight way from the start to `now`.
  double until(const Points& before, const Points& now) const;

 private:
  Points reference_;
  double distance_m_ = 0.0;
  double deviation_m_ = 0.0;  ///< of a vertex from its place in the reference, moved rigidly
};

}  // namespace softbody
