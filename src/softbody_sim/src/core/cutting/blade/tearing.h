#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "cutting/patch/cut_patch.h"

namespace softbody {

/// Watches a body for material that is stretched too far.
class TearWatch {
 public:
  /// @param strain principal stretch beyond 1 that the material bears; 0: all.
  explicit TearWatch(double strain) : strain_(strain) {}

  /// The patch along which the body tears now: once tets have been stretched beyond the limit in several
  /// states on end, the section through them, and those beyond the limit that it reaches from tet to tet,
  /// across the principal direction of the most stretched one. At the body's surface it goes on by a tenth of
  /// a mean edge. After a patch the watch begins anew; if it does not become a cut, the same tet asks for
  /// none until it has been within the limit, or is stretched 1.1 times as far as when it asked.
  /// @param vertices of the volume in the next state [m].
  std::optional<CutPatch> follow(const TetTopology& volume, const Points& vertices);

 private:
  double strain_;
  std::uint32_t revision_ = 0;
  std::vector<int> states_beyond_;  ///< per tet, on end up to the last one
  std::vector<double> asked_at_;    ///< stretch per tet, while it is beyond the limit; 0: has not asked
};

/// A tet's greatest principal stretch, and its direction at rest.
struct PrincipalStretch {
  double stretch = 1.0;
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();
};
PrincipalStretch principalStretch(const TetTopology& volume, const Points& vertices, int tet);

}  // namespace softbody
