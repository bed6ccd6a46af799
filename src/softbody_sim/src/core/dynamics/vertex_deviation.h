#pragma once

#include <Eigen/Core>
#include <vector>

#include "dynamics/edge_distances.h"
#include "softbody_common/types.h"

namespace softbody {

/// Standard deviation of each vertex's distance from its true position [m], from what the targets measure and
/// from how far the simulation has to carry it:
///
///   variance = smallest^2 + (k_r residual of all targets)^2 + (misfit of the targets around)^2
///              + (strain (k_n d_n + k_t d_t))^2
///
/// d_n is the distance to the nearest vertex that is measured in some direction, d_t to the nearest one that
/// is measured in all three, along the tets' edges. The simulation bends the body as its material would bend;
/// its error grows with the strain, and with the distance over which it is relied on.
class VertexDeviation {
 public:
  /// Standard deviation of a vertex of a piece without any measurement [m]: it may be anywhere near.
  static constexpr double kUnknown_m = 0.1;

  explicit VertexDeviation(const TetTopology& topology);

  /// Allocates nothing once the result has its size. @param vertices after the step, #V by 3 [m].
  void compute(const std::vector<Target>& targets, const Points& vertices, std::vector<float>* deviation);

 private:
  void gather(const std::vector<Target>& targets, const Points& vertices);
  double strain(const Points& vertices) const;

  const Tets tets_;
  std::vector<Eigen::Matrix3d> rest_inverse_;  ///< of the edges, per tet
  Eigen::VectorXd volumes_;                    ///< of the tets at rest
  EdgeDistances edges_;
  std::vector<Eigen::Matrix3d> information_;  ///< per vertex: sum of weight n n^T, or of weight I
  Points misfit_;                             ///< per vertex: weighted mean of the targets' residuals
  std::vector<double> weight_;                ///< per vertex
  double noise_ = 0.0;                        ///< root mean square of the targets' residuals [m]
  std::vector<char> measured_, fixed_;        ///< per vertex: in some direction, in all directions
  std::vector<double> to_measured_, to_fixed_;
};

/// Confidence and standard deviation after a time without an image.
void fadeUnobserved(double elapsed_s, MeshState* state);

}  // namespace softbody
