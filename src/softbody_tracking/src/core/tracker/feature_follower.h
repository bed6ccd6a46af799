#pragma once

#include <vector>

#include "features/feature_matching.h"
#include "features/feature_recognition.h"
#include "features/orb_extractor.h"
#include "patches/gray_pyramid.h"
#include "prediction/color_model.h"
#include "tracker/piece_search.h"
#include "tracker/rendered_prediction.h"
#include "tracker/search_backoff.h"

namespace softbody {

/// What the follower searches for, and where.
struct FollowedBody {
  const RgbdFrame& frame;
  const std::vector<MapFeature>& known;
  const ColorModel& colors;
  /// Of each piece, whether its features show if the prediction is right; not so for a piece that is held.
  std::vector<bool> followed;
};

/// The features of one frame.
struct FollowedFeatures {
  ExpectedFeatures expected;  ///< for the last rendering of the prediction
  FeatureMatches found;
};

/// Finds the known features in a frame. Where most of them are not at their predicted pixels, it moves the
/// prediction: first to where features and depth around it point, then each missing piece to where it is
/// recognised.
class FeatureFollower {
 public:
  explicit FeatureFollower(const TrackerConfig& config)
      : features_(config.features), reach_m_(config.depth.max_distance_m) {}

  /// Matches with outliers marked. @param prediction as rendered; rendered again where the body was found.
  FollowedFeatures follow(const FollowedBody& body, RenderedPrediction* prediction);

  /// Where a pose of the undeformed body would show the features: aligned without any search, outliers not
  /// marked.
  FollowedFeatures alignAt(const Points& vertices, const FollowedBody& body, RenderedPrediction* prediction);

  /// Pairs features with keypoints of the whole image. @param vertices of the volume, as expected.
  std::vector<PointPair> recognize(const FollowedBody& body, const PredictedSurface& surface,
                                   const Points& vertices);

  /// Grey image around the body in the last frame.
  const GrayPyramid& image() const { return image_; }

  /// The body has other pieces now.
  void forgetPieces() { piece_search_.forgetPieces(); }
  void reset();

 private:
  void buildImage(const RgbdFrame& frame, const PredictedSurface& surface, int reach_px);
  ExpectedFeatures expect(const FollowedBody& body, const PredictedSurface& surface);
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
  GrayPyramid image_;
  SearchBackoff wide_search_;
  PieceSearch piece_search_;
};

}  // namespace softbody
