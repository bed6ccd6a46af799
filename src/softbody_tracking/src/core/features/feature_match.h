#pragma once

#include <algorithm>
#include <opencv2/core.hpp>
#include <vector>

#include "prediction/association.h"
#include "prediction/predicted_surface.h"

namespace softbody {

/// A map feature found in a frame.
struct FeatureMatch {
  int feature = 0;  ///< index into FeatureMap::features()
  cv::Point2f pixel;
  Association association;   ///< with the measured 3-D position; all three directions count
  double unexplained = 0.0;  ///< share of the patch's variance that the image does not reproduce, 0..1
  bool inlier = true;
};

/// Number of matches on some of the pieces. @param pieces for each piece, whether its matches count.
inline int matchesOn(const std::vector<bool>& pieces, const std::vector<FeatureMatch>& matches) {
  return static_cast<int>(std::count_if(matches.begin(), matches.end(), [&](const FeatureMatch& match) {
    return pieces[match.association.piece];
  }));
}

/// Moves the predicted positions with their pieces.
inline void movePredictions(const RigidMotions& motions, std::vector<FeatureMatch>* matches) {
  for (FeatureMatch& match : *matches)
    match.association.predicted = motions[match.association.piece] * match.association.predicted;
}

}  // namespace softbody
