#pragma once

#include <Eigen/Core>
#include <vector>

#include "softbody_common/types.h"

namespace softbody {

/// Decides for each vertex how much of a new measurement is motion, and how much is noise: by the correlation
/// of a correction with the one before (Mehra 1970). The corrections of a good prediction are white noise. If
/// the body moves otherwise than predicted, neighbouring corrections are alike, also while it turns back.
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
  Points last_;                       ///< corrections
  Eigen::VectorXd product_, square_;  ///< means of a correction times the one before, and times itself
  std::vector<double> gains_;         ///< empty before observe()
};

}  // namespace softbody
