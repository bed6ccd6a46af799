#pragma once

#include <Eigen/Core>
#include <vector>

#include "softbody_common/types.h"

namespace softbody {

/// Deformation gradients averaged over the tets around each vertex (node-based smoothed finite elements: Liu,
/// Nguyen-Thoi, Nguyen-Xuan, Lam 2009): F_v = sum_i x_i g_i^T over the vertices i of those tets. A linear tet
/// has a single strain and locks in bending; the average does not.
struct SmoothedGradients {
  std::vector<int> first;      ///< #V + 1: first row of each vertex in `vertices` and `gradients`
  std::vector<int> vertices;   ///< i, including v itself; symmetric: v is also a neighbour of i
  Eigen::MatrixX3d gradients;  ///< g_i [1/m]
  Eigen::VectorXd volumes;     ///< #V, a quarter of the volume of the tets around it [m^3]
};

/// @param tets of positive volume; every vertex belongs to one.
SmoothedGradients smoothedGradients(const Points& rest_vertices, const Tets& tets);

}  // namespace softbody
