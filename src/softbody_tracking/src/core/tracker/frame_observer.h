#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "alignment/usual_error.h"
#include "features/feature_map.h"
#include "labels/region_colors.h"
#include "tracker/feature_admission.h"
#include "tracker/feature_finder.h"
#include "tracker/guesses.h"
#include "tracker/observation.h"
#include "view/view_measurements.h"

namespace softbody {

/// What a frame shows of the body.
struct ObservedBody {
  Observation seen;
  PredictedSurface surface;  ///< the best guess, aligned rigidly with the frame
  GrayPyramid image;         ///< grey image of the frame around it
  Labels labels;             ///< of the frame around it
};

/// Measures one body in each frame, starting from its predicted place: features, depth and outline. Keeps
/// what it learns: the body's features and colours, and the noise of depth.
class FrameObserver {
 public:
  FrameObserver(const TrackerConfig& config, const TetTopology& volume, const MeshTopology& surface);

  /// Changes weights and limits.
  void setConfig(const TrackerConfig& config);

  /// Continues with the edited body. What was learned is kept.
  void setTopologies(const TetTopology& volume, const MeshTopology& surface);

  /// @param predicted vertices of the volume, camera frame [m].
  ObservedBody observe(const RgbdFrame& frame, const Points& predicted);

  /// Learns new features from an observed frame, and drops unreliable ones.
  /// @param deviations of the volume's vertices [m]; empty: not estimated.
  void learnFeatures(const RgbdFrame& frame, const ObservedBody& observed,
                     const std::vector<float>& deviations = {});

  /// Pose of the undeformed body at which its features are recognised in the whole frame.
  std::optional<Eigen::Isometry3d> recognizePose(const RgbdFrame& frame) const;

  /// Share of the expected features that the frame shows at a pose of the undeformed body; -1 if too few are
  /// expected.
  double featureShare(const RgbdFrame& frame, const Eigen::Isometry3d& pose);

  const SurfaceModel& model() const { return *model_; }
  const std::vector<MapFeature>& features() const { return map_.features(); }
  const RegionColors& colors() const { return colors_; }

  /// To be called when the body was found again somewhere: the last frame says nothing about the next one.
  /// @param searched a search compared its silhouette with the frame.
  void foundAgain(bool searched);

  /// Forgets what was learned.
  void reset();

 private:
  SoughtFeatures soughtIn(const RgbdFrame& frame) const;
  Observation measure(const RgbdFrame& frame, const View& view, const Labels& labels,
                      const RigidMotions& motions, FoundFeatures features);

  TrackerConfig config_;
  std::optional<Nanoseconds> last_stamp_;
  double elapsed_s_ = 0.0;  ///< from the frame before to the last one; infinite for the first
  std::shared_ptr<const SurfaceModel> model_;
  ViewSettings view_settings_;
  MeasurementWeights weights_;
  RasterMemory memory_;
  LabelMemory last_labels_;
  DepthNoiseEstimator depth_noise_;
  UsualError usual_error_;
  bool searched_ = false;  ///< see foundAgain()
  FeatureMap map_;
  RegionColors colors_;
  FeatureFinder finder_;
  Guesses guesses_;
  FeatureAdmission admission_;
  /// Per piece: at least partly visible in the last frame; empty: all.
  std::vector<bool> tracked_before_;
};

}  // namespace softbody
