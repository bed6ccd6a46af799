#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// What earlier frames have measured of a body, per vertex. Empty: nothing.
struct RememberedShape {
  Eigen::VectorXd frames;          ///< #V: how many frames the memory is worth
  Points innovations;              ///< #V by 3: of the last frame [m]
  std::array<Points, 3> measured;  ///< #V by 3: places in the last three frames, the last one first [m]
  Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>
      noise;               ///< #V by 2: fading sum of squares of third differences [m^2], and of their number
  Eigen::VectorXd motion;  ///< #V: process noise over the noise of a frame
  Eigen::VectorXd variance;  ///< #V: mean square of a measured place, the smallest of the last seconds [m^2]
};

/// Averages measurements over time where the body rests, and lets go of them where it moves: a Kalman filter
/// of each vertex's place, whose process noise follows from its innovations r, the places that a frame
/// measures around a vertex relative to the last shape. With a memory of m frames and measurements of
/// variance R,
///
///   m <- m / (1 + m q / R) + 1,     q = max(|r|^2 / 3 - R (1 + 1 / m), R / (1 / rho - 1) - R / m, 0)
///
/// A q fades in 0.1 s: motions go on. R comes from third differences of the measured places over time: a
/// motion of constant acceleration drops out. What is left of faster ones only adds to it, so R is the
/// smallest value of the last seconds (minimum statistics; Martin 2001, Noise power spectral density
/// estimation). rho is the autocorrelation of the innovations from frame to frame; those of an optimal filter
/// are white (Mehra 1970, On the identification of variances and adaptive Kalman filtering). Innovations and
/// their squares are means over the tets around a vertex.
class ShapeMemory {
 public:
  /// @param memory_s time in which a memory fades to 1/e also at rest; 0: there is none.
  ShapeMemory(const Tets& tets, double memory_s) : tets_(tets), memory_s_(memory_s) {}

  /// @param targets of this frame. @param vertices last shape, #V by 3 [m].
  /// @param elapsed_s since then; 0: the targets are not new.
  /// @param means the targets at the means of what this frame and earlier ones measured.
  /// @return these, or the targets if there is no memory.
  const std::vector<Target>& recall(const std::vector<Target>& targets, const Points& vertices,
                                    double elapsed_s, RememberedShape* memory,
                                    std::vector<Target>* means) const;

 private:
  struct Innovations;

  Innovations innovationsOf(const std::vector<Target>& targets, const Points& vertices) const;
  void adapt(const Innovations& innovations, const Points& vertices, double elapsed_s,
             RememberedShape* memory) const;

  const Tets tets_;
  const double memory_s_;
};

}  // namespace softbody
