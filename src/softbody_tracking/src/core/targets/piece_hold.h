#pragma once

#include <vector>

#include "softbody_common/types.h"

namespace softbody {

/// Targets that keep pieces of a cut body where they are while nothing measures them.
class PieceHold {
 public:
  /// Of a target of all measurements' kind; far stiffer than a vertex's inertia, far softer than what is
  /// seen, and too little to count as observed.
  static constexpr double kWeak = 0.01;

  explicit PieceHold(const TetTopology& volume);

  /// Adds a target at each of the vertices. @param positions #V by 3 of the volume, where they are to be [m].
  void add(const std::vector<int>& vertices, const Points& positions, double weight,
           std::vector<Target>* targets) const;

 private:
  std::vector<MaterialPoint> places_;  ///< of the volume's vertices
};

}  // namespace softbody
