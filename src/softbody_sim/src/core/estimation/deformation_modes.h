#pragma once

#include <Eigen/Core>

#include "elasticity/strain_smoothing.h"
#include "softbody_common/types.h"

namespace softbody {

/// The lowest vibration modes of a body at rest: K s = w^2 M s, without those that move pieces rigidly. They
/// bend, twist and stretch whole sections, and then parts of them.
struct DeformationModes {
  Eigen::MatrixXd shapes;     ///< 3 #V by #modes, x y z of each vertex; orthonormal by mass [1/sqrt(kg)]
  Eigen::VectorXd stiffness;  ///< w^2 of each mode [1/s^2]; ascending for each piece, one after the other
};

/// @param masses lumped, #V [kg]. @param count at most; small bodies have fewer.
DeformationModes deformationModes(const TetTopology& topology, const ElasticMaterials& materials,
                                  const Eigen::VectorXd& masses, Eigen::Index count);

}  // namespace softbody
