#pragma once

#include <optional>

#include "softbody_evaluation/measures/statistics.h"
#include "softbody_evaluation/models/model.h"

namespace softbody::evaluation {

/// How well two surfaces, or parts of them, agree. Samples have equal shares of the area.
struct SurfaceAgreement {
  double share = 0.0;                                   ///< of the scanned surface, 0..1
  Summary to_truth;                                     ///< from the scanned surface to the true one [m]
  Summary to_scanned;                                   ///< from the true surface to the scanned one [m]
  double within_1mm = kNothing, within_2mm = kNothing;  ///< of the true surface: scanned surface is there
};

/// A scanned surface, compared with the true one.
struct ModelReport {
  Eigen::Isometry3d T_true_scanned = Eigen::Isometry3d::Identity();
  SurfaceAgreement whole;
  std::optional<SurfaceAgreement> seen, unseen;  ///< if the scan says what was never seen
  std::optional<double> scanned_m3, true_m3;     ///< if the surface is closed
  Summary color;                                 ///< mean of |difference| of blue, green, red [8-bit steps]
  Eigen::Vector3d gain = Eigen::Vector3d::Constant(kNothing);  ///< scanned over true: blue, green, red
};

/// @param T_true_scanned motion of the scanned surface into the frame of the true one. @param seed of the
/// samples. A part of the true surface was seen if the nearest scanned place was.
ModelReport compareModels(const Model& scanned, const Model& truth, const Eigen::Isometry3d& T_true_scanned,
                          std::uint64_t seed);

}  // namespace softbody::evaluation
