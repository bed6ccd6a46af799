#pragma once

#include <Eigen/Core>
#include <vector>

#include "softbody_common/types.h"
#include "tets/block_tet_matrix.h"
#include "tets/tet_matrix.h"

namespace softbody {

/// Springs between material points and their measured positions: k/2 |S x - p|^2, or k/2 (n . (S x - p))^2
/// with a normal n. S interpolates barycentrically. Contacts are one-sided springs: they push along the
/// normal and never pull. The springs of friction act across their normal, and slide at a largest force.
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
    double slide_m =
        -1.0;  ///< of friction: offset at which the force no longer grows [m]; below 0: no friction

    bool isFriction() const { return slide_m >= 0.0; }
  };

  /// Replaces all springs. Does not check the targets. @param unit_stiffness of a target of weight 1 [N/m].
  void set(const std::vector<Target>& targets, const Tets& tets, double unit_stiffness);

  /// Adds a one-sided spring. It acts when its point is behind the plane through `position` with the normal.
  void addOneSided(const MaterialPoint& place, const Tets& tets, const Eigen::Vector3d& position,
                   const Eigen::Vector3d& normal, double stiffness);

  /// Adds a spring of friction: it pulls the point back to `anchor`, in the plane with the normal, and with
  /// `largest_force` [N] at most.
  void addFriction(const MaterialPoint& place, const Tets& tets, const Eigen::Vector3d& anchor,
                   const Eigen::Vector3d& normal, double stiffness, double largest_force);

  /// Energy [J]; adds its gradient [N], #V by 3.
  double addTo(const Points& x, Points* gradient) const;

  /// Adds sum k S^T S: the exact curvature of point targets and an upper bound for those with a normal (n n^T
  /// <= I).
  void addMetric(TetMatrix* matrix) const;

  /// Adds the exact Hessian.
  void addHessian(const Points& x, BlockTetMatrix* matrix) const;

  /// Rank-one terms v v^T by which this metric differs from that of `earlier`. Targets are matched by place
  /// and order.
  /// @return false if there are more than `max_count`; then both lists are incomplete.
  bool metricChanges(const TargetEnergy& earlier, std::size_t max_count, std::vector<TetVector>* added,
                     std::vector<TetVector>* removed) const;

  const std::vector<Spring>& springs() const { return springs_; }
  bool hasContact() const;

  /// Second derivative of a spring's energy by the place of its point [N/m]. Zero for a one-sided spring that
  /// does not act.
  static Eigen::Matrix3d curvatureAt(const Spring& spring, const Points& x);

 private:
  static Eigen::Vector3d offsetOf(const Spring& spring, const Points& x);

  std::vector<Spring> springs_;
};

}  // namespace softbody
