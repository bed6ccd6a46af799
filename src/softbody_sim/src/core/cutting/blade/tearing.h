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

  /// The patch along which the body tears now, if a tet is stretched beyond the limit, and that is sure: by
  /// five of its standard deviations, or by the tracked features around it. The patch is a plane section
  /// through the connected tets that are stretched by more than half the limit. The tracked features say
  /// where the plane is. It overhangs the body's surface by a tenth of a mean edge. If the patch does not
  /// become a cut, the same tet gives no further patch until it has been within the limit, or until it is
  /// stretched 1.1 times as far.
  /// @param state of the volume. @param targets that led to it, of the same revision.
  std::optional<CutPatch> follow(const TetTopology& volume, const MeshState& state,
                                 const std::vector<Target>& targets);

 private:
  double strain_;
  std::uint32_t revision_ = 0;
  std::vector<double> asked_at_;  ///< per tet: stretch at its last patch, while beyond the limit; 0: no patch
};

}  // namespace softbody
