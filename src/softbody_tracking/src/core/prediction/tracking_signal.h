#pragma once

#include <Eigen/Core>
#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// Decides for each vertex how much of a new measurement is motion, and how much is noise. The corrections of
/// a good prediction are white noise. If the body moves otherwise than predicted, successive corrections lie
/// on a smooth curve, so their second differences are small (adaptive filtering by innovations: Mehra 1970).
class TrackingSignal {
 public:
  /// @param corrections #V by 3, new minus predicted positions [m]. @param elapsed_s since the last ones.
  void observe(const Points& corrections, double elapsed_s);

  /// For each vertex, the share of a measurement to follow: near 0 at rest, 1 in unpredicted motion and
  /// before observe().
  double gain(Eigen::Index vertex) const {
    return gains_.empty() ? 1.0 : gains_[static_cast<std::size_t>(vertex)];
  }

  void reset() { gains_.clear(); }

 private:
  Points last_, before_;            ///< the last two corrections
  Eigen::VectorXd square_, noise_;  ///< mean square of the corrections, and of their noise
  std::vector<double> gains_;       ///< empty before observe()
};

}  // namespace softbody
