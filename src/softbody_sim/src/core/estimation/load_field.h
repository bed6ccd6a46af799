#pragma once

#include <Eigen/Core>

#include "elasticity/tet_materials.h"
#include "estimation/deformation_modes.h"
#include "softbody_common/types.h"

namespace softbody {

/// Covariance along the modes of loads of which nothing is known: a random field of forces in the volume that
/// is smooth over the size of a hand (Matern; Lindgren et al. 2011: white noise behind a screened Poisson
/// equation), and that deforms the body by a usual strain. @param masses lumped, #V [kg].
Eigen::MatrixXd covarianceOfUnknownLoads(const TetTopology& topology, const TetMaterials& materials,
                                         const Eigen::VectorXd& masses, const DeformationModes& modes);

}  // namespace softbody
