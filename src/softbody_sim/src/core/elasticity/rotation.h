#pragma once

#include <Eigen/Core>

namespace softbody {

/// The rotation nearest to a deformation gradient (polar decomposition, never a reflection): the R that
/// maximises tr(R^T F). It depends only on F, not on the previous frame, so energies that use it are
/// functions of positions. Closed form from the largest root of a quartic (Markley 1993, "Attitude
/// determination using vector observations: a fast optimal matrix algorithm"). If R is not unique, or nearly
/// so, by the quaternion eigenproblem of Horn 1987.
/// @return tr(R^T F): the sum of the singular values, the smallest one negative if F is inverted.
double extractRotation(const Eigen::Matrix3d& F, Eigen::Matrix3d* R);

}  // namespace softbody
