#pragma once

#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// Damps the pieces of a cut body without targets, for example behind the blade. The last measured velocity
/// of an occluded piece is mostly noise. So it comes to rest while other pieces are observed.
class OccludedPieceDamping {
 public:
  explicit OccludedPieceDamping(const TetTopology& topology);

  /// Halves the velocity of pieces without targets every 0.1 s. @param velocities #V by 3 [m/s].
  void apply(const std::vector<Target>& targets, double elapsed_s, Points* velocities);

 private:
  std::vector<std::uint32_t> tet_pieces_, vertex_pieces_;
  std::vector<bool> observed_;  ///< of each piece, in this step
};

}  // namespace softbody
