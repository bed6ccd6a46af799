#pragma once

#include <Eigen/Core>
#include <vector>

#include "identification/residuals.h"

namespace softbody {

/// By how much the variances of the unknowns exceed those of independent errors, from the residuals
/// themselves: sums of the scores over patches of the body and over blocks of time (cluster-robust variance:
/// Liang and Zeger 1986; two ways: Cameron, Gelbach, Miller 2011). Of several sizes of patches and blocks,
/// the largest variance counts.
/// @param places #R. @param jacobian #R by #U and residuals #R, both over their standard deviations.
/// @param covariance (J^T J)^-1. @return #U, at least 1.
Eigen::VectorXd correlationFactors(const std::vector<ResidualPlace>& places, const Eigen::MatrixXd& jacobian,
                                   const Eigen::VectorXd& residuals, const Eigen::MatrixXd& covariance);

/// Patches of about equal numbers of residuals, by halving the longest side: the number of the patch of each.
/// Wrenches of a sensor are a patch of their own. @param halvings gives 2^halvings patches.
std::vector<int> patchesOf(const std::vector<ResidualPlace>& places, int halvings);

}  // namespace softbody
