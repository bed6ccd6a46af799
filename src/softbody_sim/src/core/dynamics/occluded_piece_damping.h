#pragma once

#include <vector>

#include "softbody_common/types.h"

namespace softbody {

/// The pieces of a cut body that the camera does not see, as behind the blade. Nothing tells where such a
/// piece goes, and the last speed that was measured of it is mostly noise: while other pieces are observed it
/// comes to rest where it is.
class OccludedPieceDamping {
 public:
  explicit OccludedPieceDamping(const TetTopology& topology);

  /// Slows the pieces without targets; the speed halves in 0.1 s. @param velocities #V by 3.
  void apply(const std::vector<Target>& targets, double elapsed_s, Points* velocities);

 private:
  std::vector<std::uint32_t> tet_bodies_, vertex_bodies_;
  std::vector<bool> seen_;  ///< of each piece, in this step
};

}  // namespace softbody
