#pragma once

#include <optional>
#include <vector>

#include "softbody_evaluation/measures/statistics.h"
#include "softbody_sim/forces/force_estimate.h"

namespace softbody::evaluation {

/// The forces of a result, compared with the true ones. Each force that was found belongs to the nearest true
/// one.
struct ForceReport {
  std::size_t frames = 0;
  Summary force_n;      ///< error of the largest true force
  double right = 0.0;   ///< share of frames in which it is within 10 % or 0.1 N, 0..1
  Summary place_m;      ///< distance of its place from the true one, where something was found
  double within = 0.0;  ///< share of all forces within their 90 % bound, 0..1
};

/// Collects over many frames.
class ForceAgreement {
 public:
  /// Without a true force of 0.1 N, the frame does not count.
  void add(const std::vector<ForcePatch>& truth, const std::vector<ForcePatch>& found);

  /// Nothing if no frame counts.
  std::optional<ForceReport> report() const;

 private:
  std::vector<float> errors_n_, places_m_;
  std::size_t right_ = 0, within_ = 0, forces_ = 0;
};

}  // namespace softbody::evaluation
