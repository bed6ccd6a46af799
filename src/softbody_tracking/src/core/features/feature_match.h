#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "prediction/association.h"
#include "softbody_common/pinhole.h"

namespace softbody {

/// A map feature found in a frame.
struct FeatureMatch {
  int feature = 0;  ///< index into FeatureMap::features()
  cv::Point2f pixel;
  Association association;   ///< to the measured 3-D position, all three directions
  double unexplained = 0.0;  ///< share of the patch's variance that the image there does not have, 0..1
  bool inlier = true;
};

/// How many of them lie on some of the pieces. @param counted of each piece.
int matchesOn(const std::vector<bool>& counted, const std::vector<FeatureMatch>& matches);

/// Marks outliers: matches that move otherwise than the linear motion in the image of their neighbours of the
/// same piece, which starts from the motion of the whole piece, so that some wrong ones side by side do not
/// lead it away; and those further from their prediction than a body moves in a frame. Twenty that are a few
/// pixels off but move alike stay, where half of those beside them do too: a limb.
/// @param max_disagreement_m in any direction; across the ray 1.5 to 4 pixels are allowed.
void markOutliers(const Pinhole& camera, double max_disagreement_m, std::vector<FeatureMatch>* matches);

/// Weighs matches by how well the image agrees with their patches, measured by what is usual among them:
/// noise and blur are the same for all, but a patch half of which is covered is found beside its place.
void weighByAgreement(std::vector<FeatureMatch>* matches);

/// Weighs matches so that the inliers together count alike, many or few: for so many measurements of every
/// vertex. Where they are very few each counts four times at most; none beyond
/// kLargestTargetWeight.
/// @param vertices of the volume that show, and are not covered.
void weighByDensity(double vertices, std::vector<FeatureMatch>* matches);

}  // namespace softbody
