#pragma once

#include <optional>
#include <vector>

#include "features/feature_map.h"
#include "prediction/color_model.h"
#include "tracker/feature_admission.h"
#include "tracker/feature_follower.h"
#include "tracker/observation.h"
#include "tracker/rendered_prediction.h"

namespace softbody {

/// Measures one body in each frame, starting from its predicted place: features, depth and outline. Keeps
/// what it learns: the body's features and colours, and the noise of depth.
class FrameObserver {
 public:
  FrameObserver(const TrackerConfig& config, const TetTopology& volume, const MeshTopology& surface);

  /// Continues with the edited body. What was learned is kept.
  void setTopologies(const TetTopology& volume, const MeshTopology& surface);

  /// @param predicted vertices of the volume, camera frame [m]. Afterwards surface() is the prediction,
  /// aligned rigidly with the frame.
  Observation observe(const RgbdFrame& frame, const Points& predicted);

  /// Learns new features from the frame last observed, and drops unreliable ones.
  /// @param deviations of the volume's vertices [m]; empty: not estimated.
  void learnFeatures(const RgbdFrame& frame, const Observation& seen,
                     const std::vector<float>& deviations = {});

  /// Pose of the undeformed body at which its features are recognised in the whole frame.
  std::optional<Eigen::Isometry3d> recognizePose(const RgbdFrame& frame);

  /// Share of the expected features that the frame shows at a pose of the undeformed body; -1 if too few are
  /// expected.
  double featureShare(const RgbdFrame& frame, const Eigen::Isometry3d& pose);

  const SurfaceModel& model() const { return prediction_.model(); }
  const PredictedSurface& surface() const { return prediction_.surface(); }
  const std::vector<MapFeature>& features() const { return map_.features(); }
  const ColorModel& colors() const { return colors_; }

  /// Forgets what was learned.
  void reset();

 private:
  FollowedBody followedBody(const RgbdFrame& frame) const;
  Observation measure(const RgbdFrame& frame, const RigidMotions& motions, FollowedFeatures features);

  TrackerConfig config_;
  RenderedPrediction prediction_;
  DepthNoiseEstimator depth_noise_;
  FeatureMap map_;
  ColorModel colors_;
  FeatureFollower follower_;
  FeatureAdmission admission_;
  std::vector<bool>
      tracked_before_;  ///< per piece: at least partial observability in the last frame; empty: all
};

}  // namespace softbody
