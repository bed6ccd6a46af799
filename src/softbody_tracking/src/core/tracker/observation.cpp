#include "tracker/observation.h"

#include <algorithm>

namespace softbody {

std::vector<bool> Observation::atLeast(Visibility least) const {
  std::vector<bool> result;
  for (const Visibility piece : visibility) result.push_back(piece >= least);
  return result;
}

Observation restrictedToVisible(Observation seen, const SurfaceSamples& samples,
                                const std::vector<Points>& pieces) {
  const std::vector<Association>& depth = seen.depth.associations;
  seen.agreeing_blocks = depth.size();
  seen.visibility = pieceVisibility(samples, depth, seen.matches, pieces);
  seen.learnable = confirmedPieces(samples, depth, pieces.size());
  seen.in_view = piecesInView(samples, pieces.size());
  const std::vector<bool> good = seen.atLeast(Visibility::kWell), tracked = seen.atLeast(Visibility::kPartly);
  seen.expected_features = seen.expected.countOn(tracked);
  seen.matched_features = matchesOn(tracked, seen.matches);
  for (std::size_t p = 0; p < good.size(); ++p) seen.learnable[p] = seen.learnable[p] || good[p];
  const auto is_uncertain = [&](const Association& association) { return !good[association.piece]; };
  for (std::vector<Association>* found : {&seen.depth.associations, &seen.outline.associations})
    found->erase(std::remove_if(found->begin(), found->end(), is_uncertain), found->end());
  for (FeatureMatch& match : seen.matches) match.inlier = match.inlier && tracked[match.association.piece];
  return seen;
}

}  // namespace softbody
