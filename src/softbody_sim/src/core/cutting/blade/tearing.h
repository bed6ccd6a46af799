#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "cutting/patch/cut_patch.h"

namespace softbody {

/// Finds material that is stretched beyond its limit.
class TearWatch {
 public:
  /// @param strain largest principal stretch minus 1 that the material withstands; 0: it never tears.
  explicit TearWatch(double strain) : strain_(strain) {}

  /// The patch along which the body tears now, if tets have been beyond the limit in several consecutive
  /// states. It is a section through the most stretched tet, perpendicular to its principal direction, and
  /// through the connected tets that are beyond the limit. It overhangs the body's surface by a tenth of a
  /// mean edge. After a patch the counting restarts. If the patch does not become a cut, the same tet gives
  /// no further patch until it has been within the limit, or until it is stretched 1.1 times as far.
  /// @param vertices of the volume in the next state [m].
  std::optional<CutPatch> follow(const TetTopology& volume, const Points& vertices);

 private:
  double strain_;
  std::uint32_t revision_ = 0;
  std::vector<int> states_beyond_;  ///< per tet: consecutive states beyond the limit
  std::vector<double> asked_at_;  ///< per tet: stretch at its last patch, while beyond the limit; 0: no patch
};

/// The largest principal stretch of a tet and its direction at rest.
struct PrincipalStretch {
  double stretch = 1.0;
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();
};
PrincipalStretch principalStretch(const TetTopology& volume, const Points& vertices, int tet);

}  // namespace softbody
