#pragma once

#include <vector>

#include "simd/rows.h"
#include "time_step/incremental_potential.h"
#include "time_step/potential_kernel.h"

namespace softbody {

/// An IncrementalPotential in rows of the precision T. Positions are relative to an origin near the body,
/// where single precision is most accurate.
template <typename T>
class PackedPotential {
 public:
  PackedPotential(Eigen::Index vertex_count, Simd simd);

  /// Allocates only when the number of targets exceeds all earlier ones.
  void set(const IncrementalPotential& potential, const Eigen::RowVector3d& origin);

  /// Energy [J]; sets its gradient [N].
  double evaluate(const Rows<T>& x, Rows<T>* gradient) const;

  /// Converts points to rows relative to the origin, and back.
  void toRows(const Points& points, Rows<T>* rows) const;
  void fromRows(const Rows<T>& rows, Points* points) const;

 private:
  Eigen::RowVector3d origin_ = Eigen::RowVector3d::Zero();
  Rows<T> inertia_;  ///< one value per row, repeated
  Rows<T> prediction_, loads_;
  std::vector<TargetRow<T>> targets_;
  PotentialKernel<T> kernel_;
};

}  // namespace softbody
