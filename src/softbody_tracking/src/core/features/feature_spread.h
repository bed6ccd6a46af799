#pragma once

#include <Eigen/Core>
#include <vector>

namespace softbody {

/// Of ranked places those that lie spread: every one at some distance from what is known and from those
/// before it that are taken, the largest distance at which as many are taken as are wanted (after Bailo et
/// al. 2018, suppression via square covering).
/// @param ranked 3 by #candidates [m], the best first. @param known 3 by #known [m]. @param gap_m the
/// smallest distance; 0: all may be taken.
/// @return indices of candidates, ascending; fewer than wanted where no more are so far apart.
std::vector<int> spreadOut(const Eigen::Matrix3Xf& ranked, const Eigen::Matrix3Xf& known, int wanted,
                           double gap_m);

/// The same where nothing is known, with most of them among the strongest: the weak, which are found again
/// less surely, fill the gaps that those leave.
/// @param gap_m no weak one is taken nearer to a strong one.
/// @return indices of candidates, the strong ones first.
std::vector<int> spreadStrong(const Eigen::Matrix3Xf& ranked, int wanted, double gap_m);

}  // namespace softbody
