#pragma once

#include <Eigen/Core>
#include <vector>

#include "elasticity/tet_materials.h"
#include "estimation/deformation_modes.h"
#include "softbody_common/geometry/types.h"

namespace softbody {

/// Covariance along the modes of each piece of loads of which nothing is known: a random field of forces in
/// the volume that is smooth over the size of a hand (Matern; Lindgren et al. 2011: white noise behind a
/// screened Poisson equation), and that deforms the body by a usual strain. @param masses lumped, #V [kg].
/// @param modes of each piece.
std::vector<Eigen::MatrixXd> covariancesOfUnknownLoads(const TetTopology& topology,
                                                       const TetMaterials& materials,
                                                       const Eigen::VectorXd& masses,
                                                       const std::vector<DeformationModes>& modes);

}  // namespace softbody
