#pragma once

#include <Eigen/Core>
#include <vector>

#include "softbody_common/types.h"
#include "tets/block_tet_matrix.h"
#include "tets/tet_matrix.h"

namespace softbody {

/// Springs between material points and where they were measured: k/2 |S x - p|^2, or k/2 (n . (S x - p))^2
/// where a normal is given. One-sided ones, which contacts are, push along the normal and never pull. S
/// interpolates barycentrically.
class TargetEnergy {
 public:
  struct Spring {
    int tet;
    Eigen::Vector4i vertices;
    Eigen::Vector4d barycentric;
    Eigen::Vector3d position;
    Eigen::Vector3d normal;  ///< unit, or zero
    double stiffness;        ///< [N/m]
    bool one_sided = false;
  };

  /// @param unit_stiffness of a target of weight 1 [N/m]. Indices and numbers must have been checked.
  void set(const std::vector<Target>& targets, const Tets& tets, double unit_stiffness);

  /// Adds a one-sided spring: its point may be anywhere on the normal's side of the plane through `position`.
  void addOneSided(const MaterialPoint& place, const Tets& tets, const Eigen::Vector3d& position,
                   const Eigen::Vector3d& normal, double stiffness);

  /// Energy [J]; adds its gradient [N], #V by 3.
  double addTo(const Points& x, Points* gradient) const;

  /// Adds sum k S^T S: the exact curvature of point targets and an upper bound for those with a normal (n n^T
  /// <= I).
  void addMetric(TetMatrix* matrix) const;

  /// Adds the exact Hessian.
  void addHessian(const Points& x, BlockTetMatrix* matrix) const;

  /// What this adds to a metric and `earlier` does not, and the other way round, as vectors v of v v^T.
  /// Targets that stay are known by their place and order. @return false, and both unfinished, if there are
  /// more than `most`.
  bool metricChanges(const TargetEnergy& earlier, std::size_t most, std::vector<TetVector>* added,
                     std::vector<TetVector>* removed) const;

  const std::vector<Spring>& springs() const { return springs_; }

 private:
  static Eigen::Vector3d offsetOf(const Spring& spring, const Points& x);

  std::vector<Spring> springs_;
};

}  // namespace softbody
