#pragma once

#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// Makes weak targets that keep vertices at given positions, for pieces of a cut body that the measurements
/// do not hold.
class PositionPrior {
 public:
  /// Weight of such a target; a target from a measurement has about 1. Such a target is far stiffer than a
  /// vertex's inertia and far softer than any measurement. A vertex with such a target does not count as
  /// observed.
  static constexpr double kPriorWeight = 0.01;

  explicit PositionPrior(const TetTopology& volume);

  /// Appends one target for each vertex. @param positions #V by 3 of the volume, wanted positions [m].
  void addTargets(const std::vector<int>& vertices, const Points& positions, double weight,
                  std::vector<Target>* targets) const;

 private:
  std::vector<MaterialPoint> places_;  ///< of the volume's vertices
};

}  // namespace softbody
