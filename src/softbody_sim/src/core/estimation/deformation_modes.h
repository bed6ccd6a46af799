#pragma once

#include <Eigen/Core>
#include <vector>

#include "elasticity/strain_smoothing.h"
#include "softbody_common/geometry/types.h"

namespace softbody {

/// The lowest vibration modes of a connected piece at rest: K s = w^2 M s, without those that move it
/// rigidly. They bend, twist and stretch whole sections, and then parts of them.
struct DeformationModes {
  Eigen::MatrixXd shapes;     ///< x y z of each of its vertices by #modes; orthonormal by mass [1/sqrt(kg)]
  Eigen::VectorXd stiffness;  ///< w^2 of each mode, ascending [1/s^2]
};

/// The modes of each piece, as verticesOfPieces orders pieces and vertices. @param masses lumped, #V [kg].
/// @param count of all, by the pieces' numbers of vertices; small pieces have fewer.
std::vector<DeformationModes> deformationModes(const TetTopology& topology, const ElasticMaterials& materials,
                                               const Eigen::VectorXd& masses, Eigen::Index count);

}  // namespace softbody
