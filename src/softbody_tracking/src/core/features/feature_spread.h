#pragma once

#include <Eigen/Core>
#include <vector>

namespace softbody {

/// Chooses ranked places that are spread evenly: each keeps a distance from the known places and from better
/// places. The distance is the largest that still gives the wanted number (after Bailo et al. 2018,
/// suppression via square covering).
/// @param ranked 3 by #candidates [m], the best first. @param known 3 by #known [m]. @param gap_m smallest
/// distance.
/// @return indices of candidates, ascending; fewer than wanted if the gap leaves no more.
std::vector<int> spreadOut(const Eigen::Matrix3Xf& ranked, const Eigen::Matrix3Xf& known, int wanted,
                           double gap_m);

/// The same without known places. Most places are those of the strongest candidates. Weak candidates, which
/// are found again less reliably, fill the gaps.
/// @param gap_m smallest distance of a weak place from a strong one.
/// @return indices of candidates, the strong ones first.
std::vector<int> spreadStrong(const Eigen::Matrix3Xf& ranked, int wanted, double gap_m);

}  // namespace softbody
