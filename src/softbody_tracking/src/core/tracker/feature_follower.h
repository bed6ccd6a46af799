#pragma once

#include <vector>

#include "features/feature_matching.h"
#include "features/feature_recognition.h"
#include "features/orb_extractor.h"
#include "patches/gray_pyramid.h"
#include "prediction/color_model.h"
#include "tracker/frame_matcher.h"
#include "tracker/piece_search.h"
#include "tracker/rendered_prediction.h"
#include "tracker/search_backoff.h"

namespace softbody {

/// What the follower searches for, and where.
struct FollowedBody {
  const RgbdFrame& frame;
  const std::vector<MapFeature>& known;
  const ColorModel& colors;
  /// For each piece: true if its features are expected at their predicted places; false for a piece that is
  /// held.
  std::vector<bool> followed;
};

/// The features of one frame.
struct FollowedFeatures {
  ExpectedFeatures expected;  ///< for the last rendering of the prediction
  FeatureMatches found;
};

/// Finds the known features in a frame. If most of them are not at their predicted pixels, it moves the
/// prediction in two steps. First the features and the depth around the prediction move it. Then each piece
/// that is still missing is moved to the place where it is recognised.
class FeatureFollower {
 public:
  explicit FeatureFollower(const TrackerConfig& config)
      : features_(config.features), reach_m_(config.depth.max_distance_m), frame_matcher_(config.features) {}

  /// Matches with outliers marked. @param prediction as rendered; if it is moved, it is rendered again.
  FollowedFeatures follow(const FollowedBody& body, RenderedPrediction* prediction);

  /// The features at a pose of the undeformed body. Their patches are aligned, but not searched for further
  /// away. Outliers are not marked.
  FollowedFeatures alignAt(const Points& vertices, const FollowedBody& body, RenderedPrediction* prediction);

  /// Pairs features with keypoints of the whole image. @param vertices of the volume, as expected.
  std::vector<PointPair> recognize(const FollowedBody& body, const SurfaceModel& model,
                                   const Points& vertices);

  /// Grey image around the body in the last frame.
  const GrayPyramid& image() const { return image_; }

  /// To be called when the body has other pieces.
  void forgetPieces() { piece_search_.forgetPieces(); }
  void reset();

 private:
  void buildImage(const RgbdFrame& frame, const PredictedSurface& surface, int reach_px);
  ExpectedFeatures expect(const FollowedBody& body, const PredictedSurface& surface);
  std::vector<Keypoint> keypointsOfImage(const FollowedBody& body);
  FollowedFeatures matchLastFrame(const FollowedBody& body, const PredictedSurface& surface);
  FollowedFeatures matchAround(const FollowedBody& body, RenderedPrediction* prediction);
  FollowedFeatures searchWide(const FollowedBody& body, const PredictedSurface& surface,
                              FollowedFeatures features);
  FollowedFeatures improvePrediction(const FollowedBody& body, FollowedFeatures features,
                                     RenderedPrediction* prediction);
  FollowedFeatures searchPieces(const FollowedBody& body, const std::vector<bool>& due,
                                FollowedFeatures features, RenderedPrediction* prediction);

  FeatureConfig features_;
  double reach_m_;  ///< see expectFeatures()
  OrbExtractor orb_;
  FrameMatcher frame_matcher_;
  GrayPyramid image_;
  SearchBackoff wide_search_;
  PieceSearch piece_search_;
};

}  // namespace softbody
