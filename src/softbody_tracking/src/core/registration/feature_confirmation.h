#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "registration/found_pose.h"

namespace softbody {

/// Share of the body's expected features that the frame shows at a pose, 0..1; negative if too few are
/// expected.
using FeatureShare = std::function<double(const Eigen::Isometry3d&)>;

/// Whether the features confirm a pose.
bool confirms(double feature_share);

/// Poses in one place that look alike in depth, and the FeatureShare at each.
struct AlikePoses {
  std::vector<Eigen::Isometry3d> poses;
  std::vector<double> shares;
};

/// The pose with the largest share of features, if they confirm it.
std::optional<FoundPose> confirmedPose(const AlikePoses& alike);

/// The first pose with too few expected features to decide. FoundPose::alike counts all such poses.
std::optional<FoundPose> undecidedPose(const AlikePoses& alike);

}  // namespace softbody
