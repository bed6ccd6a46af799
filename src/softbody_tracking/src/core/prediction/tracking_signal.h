#pragma once

#include <Eigen/Core>
#include <vector>

#include "softbody_common/types.h"

namespace softbody {

/// Decides for each vertex how much of a new measurement is motion, and how much is noise: the tracking
/// signal of Trigg and Leach 1967, for vectors. The corrections of a good prediction point in random
/// directions, so their mean is far shorter than their mean length. If the body moves otherwise than
/// predicted, the corrections point in one direction.
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
  Points mean_;                  ///< of the corrections
  Eigen::VectorXd mean_length_;  ///< of the corrections
  std::vector<double> gains_;    ///< empty before observe()
};

}  // namespace softbody
