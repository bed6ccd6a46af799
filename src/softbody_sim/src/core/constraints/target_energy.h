#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include "softbody_common/geometry/types.h"
#include "tets/block_tet_matrix.h"
#include "tets/tet_matrix.h"

namespace softbody {

/// Springs between material points and their measured positions: k/2 |S x - p|^2, or k/2 (n . (S x - p))^2
/// with a normal n. S interpolates barycentrically. Contacts are one-sided springs: they push along the
/// normal and never pull. The springs of friction act across their normal, and slide at a largest force.
/// A coupled spring acts between two material points a and b: S x = S_a x - S_b x, so b gets the opposite
/// force.
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

    int other_tet = -1;  ///< of a coupled spring: the tet of point b
    Eigen::Vector4i other_vertices = Eigen::Vector4i::Zero();
    Eigen::Vector4d other_barycentric = Eigen::Vector4d::Zero();

    bool isFriction() const { return slide_m >= 0.0; }
    bool isCoupled() const { return other_tet >= 0; }
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

  /// Makes the spring that was added last act between its point and this one. Its position is relative to it.
  void coupleLast(const MaterialPoint& other, const Tets& tets);

  /// Energy [J]; adds its gradient [N], #V by 3.
  double addTo(const Points& x, Points* gradient) const;

  /// Adds sum k S^T S: the exact curvature of point targets and an upper bound for those with a normal (n n^T
  /// <= I). For coupled springs, 2 k S_a^T S_a + 2 k S_b^T S_b is an upper bound that couples no tets.
  void addMetric(TetMatrix* matrix) const;

  /// Adds a diagonal matrix that is an upper bound of addMetric's: its sums of absolute values in each row
  /// [N/m], #V.
  void addMetricBound(Eigen::VectorXd* diagonal) const;

  /// Adds the exact Hessian, without the entries that couple two tets.
  void addHessian(const Points& x, BlockTetMatrix* matrix) const;

  /// Adds the entries of the Hessian that couple two tets, of the lower triangle, as BlockTetMatrix numbers
  /// the coordinates.
  void addCouplings(const Points& x, std::vector<Eigen::Triplet<double>>* entries) const;

  /// Rank-one terms v v^T by which this metric differs from that of `earlier`. Targets are matched by place
  /// and order.
  /// @return false if there are more than `max_count`; then both lists are incomplete.
  bool metricChanges(const TargetEnergy& earlier, std::size_t max_count, std::vector<TetVector>* added,
                     std::vector<TetVector>* removed) const;

  const std::vector<Spring>& springs() const { return springs_; }
  bool hasContact() const;
  bool hasCoupled() const;

  /// Second derivative of a spring's energy by the place of its point [N/m]. Zero for a one-sided spring that
  /// does not act.
  static Eigen::Matrix3d curvatureAt(const Spring& spring, const Points& x);

 private:
  static Eigen::Vector3d offsetOf(const Spring& spring, const Points& x);

  std::vector<Spring> springs_;
};

}  // namespace softbody
