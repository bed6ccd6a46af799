#pragma once

#include <optional>
#include <vector>

#include "alignment/rigid_alignment.h"
#include "alignment/shown_pieces.h"
#include "depth/depth_associations.h"
#include "depth/outline_associations.h"
#include "features/feature_map.h"
#include "features/feature_recognition.h"
#include "features/gray_pyramid.h"
#include "features/orb_extractor.h"
#include "prediction/color_model.h"
#include "prediction/predicted_surface.h"
#include "prediction/surface_samples.h"
#include "tracker/search_pace.h"

namespace softbody {

/// What a frame's images give against a prediction.
struct Observation {
  std::vector<FeatureMatch> matches;
  int expected_features = 0;        ///< on pieces that do not hardly show,
  int matched_features = 0;         ///< and matches of them, outliers too
  DepthAssociations depth;          ///< of pieces that show well
  std::size_t agreeing_blocks = 0;  ///< of depth, of all pieces
  std::vector<Association> outline;
  std::vector<Shows> shown;     ///< of each piece of the body
  std::vector<bool> in_view;    ///< of each, whether enough of it to follow it should show
  std::vector<bool> learnable;  ///< of each, whether what is seen of it is certainly at its place

  /// Of each piece, whether it shows at least so well.
  std::vector<bool> atLeast(Shows least) const;
};

/// Follows one body from a predicted to the observed place: features and depth, associated and brought
/// together by a rigid motion. Keeps what it learns of the body's features and colours.
class FrameObserver {
 public:
  FrameObserver(const TrackerConfig& config, const TetTopology& volume, const MeshTopology& surface);

  /// Goes on with the edited body: features and colours stay.
  void setTopologies(const TetTopology& volume, const MeshTopology& surface);

  /// @param vertices of the volume as predicted, camera frame. Afterwards surface() is the prediction moved
  /// rigidly to what was observed.
  Observation observe(const RgbdFrame& frame, const Points& vertices);

  /// Binds new features on surface with few, and drops those that are hardly ever found again.
  void admit(const RgbdFrame& frame, const Observation& seen);

  /// Where the undeformed body is by the features that are recognised anywhere in the frame.
  std::optional<Eigen::Isometry3d> recognize(const RgbdFrame& frame);

  /// Share of the known features that show at a pose of the undeformed body; -1 where too few should.
  double featureShare(const RgbdFrame& frame, const Eigen::Isometry3d& pose);

  const PredictedSurface& surface() const { return surface_; }
  const FeatureMap& map() const { return map_; }
  const ColorModel& colors() const { return colors_; }

  /// Forgets features and colours.
  void reset();

 private:
  /// Of a piece: features expected where it was predicted, and inliers found there.
  struct FeatureCount {
    int expected = 0, found = 0;
    bool hardlyAny() const;
  };

  void look(const RgbdFrame& frame, const Points& vertices);
  RigidMotions alignRigidly(const RgbdFrame& frame, const std::vector<FeatureMatch>& matches);
  void learnColors(const RgbdFrame& frame);
  cv::Rect searchRegion(const cv::Size& size, int reach_px) const;
  void buildPyramid(const RgbdFrame& frame, int reach_px);
  cv::Rect nextTile();
  void expectFeatures(const RgbdFrame& frame);
  std::vector<FeatureMatch> alignFeatures(const RgbdFrame& frame);
  std::vector<bool> followedPieces() const;
  bool farOff(const std::vector<FeatureMatch>& scouts) const;
  bool hardlyAny(const std::vector<FeatureMatch>& matches) const;
  bool few(const std::vector<FeatureMatch>& matches) const;
  std::vector<PointPair> recognizeFeatures(const RgbdFrame& frame, const Points& vertices);
  FeatureCount countOn(std::size_t piece, const std::vector<FeatureMatch>& matches) const;
  std::vector<bool> gonePieces(const std::vector<FeatureMatch>& matches);
  void lookWhereRecognized(const RgbdFrame& frame, const std::vector<bool>& gone, Observation* seen);
  void followFeatures(const RgbdFrame& frame, Observation* seen);
  std::vector<Keypoint> extract(const RgbdFrame& frame);
  void keepShownPieces(Observation* seen) const;
  double vertices() const;
  int enoughFeatures() const;
  void admitNew(const RgbdFrame& frame, const Observation& seen, int room);

  TrackerConfig config_;
  double volume_edge_m_ = 0.0;  ///< mean length of the volume's edges
  PredictedSurface surface_;
  DepthAssociator depth_;
  DepthNoiseEstimator depth_noise_;
  OutlineAssociator outline_;
  RigidAlignment rigid_;
  SurfaceSamples samples_;  ///< of the prediction
  OrbExtractor orb_;
  GrayPyramid pyramid_;
  FeatureMap map_;
  ColorModel colors_;
  std::vector<bool>
      shown_before_;  ///< of each piece, whether the last frame did not hardly show it; none: all
  int frames_to_admission_ = 0;
  int tiles_in_vain_ = 0;     ///< looked through since the last new feature
  int frames_to_search_ = 0;  ///< for pieces that are held
  SearchPace wide_search_;
  std::vector<SearchPace> searches_;  ///< for each that is followed
  int tile_ = 0;                      ///< of the surface, where new features are looked for next
};

}  // namespace softbody
