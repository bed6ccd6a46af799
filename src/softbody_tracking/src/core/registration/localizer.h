#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "registration/body_finder.h"

namespace softbody {

/// A pose in which the body explains a frame.
struct Localization {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  /// Poses in the same place that explain it as well, this one included: above 1 for a symmetric body.
  int alike = 1;
};

/// Where the body is in a frame that no prediction helps with.
class Localizer {
 public:
  /// How well the body's features are found at a pose: their share of those expected; negative where too few
  /// are expected to tell.
  using FeatureShare = std::function<double(const Eigen::Isometry3d&)>;

  Localizer(const TriangleMesh& rest_surface, const RegistrationConfig& config);

  /// Near a rough pose that somebody gave.
  std::optional<Localization> near(const RgbdFrame& frame, const Eigen::Isometry3d& rough_pose) const;

  /// Near a pose at which its features were recognised, which tell poses apart that look alike in depth.
  std::optional<Localization> recognized(const RgbdFrame& frame, const Eigen::Isometry3d& pose,
                                         const FeatureShare& feature_share) const;

  /// Anywhere. Among poses alike in depth the one with most features. Where they are hardly found, it is not
  /// the body; there, and where too few are expected to tell, the next place is looked at, which only
  /// features that are found can make the body's.
  std::optional<Localization> anywhere(const RgbdFrame& frame, const ColorModel& colors,
                                       const std::vector<Eigen::Isometry3d>& guesses,
                                       const FeatureShare& feature_share) const;

 private:
  bool inSamePlace(const Pinhole& camera, const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) const;
  double foreignShare(const RgbdFrame& frame, const ColorModel& colors, const Eigen::Isometry3d& pose) const;

  RegistrationConfig config_;
  TriangleMesh rest_surface_;
  TriangleMesh coarse_;  ///< for rendering small
  BodyFinder finder_;
};

}  // namespace softbody
