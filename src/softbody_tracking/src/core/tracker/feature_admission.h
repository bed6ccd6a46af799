#pragma once

#include "features/feature_map.h"
#include "features/orb_extractor.h"
#include "labels/labels.h"
#include "patches/gray_pyramid.h"
#include "prediction/predicted_surface.h"
#include "tracker/backoff.h"
#include "tracker/observation.h"

namespace softbody {

/// The frame that new features are learned from.
struct LearnedFrame {
  const RgbdFrame& frame;
  const Observation& seen;
  const PredictedSurface& surface;  ///< aligned with the frame
  const Labels& labels;             ///< of the frame
  const GrayPyramid& image;
  const std::vector<float>& deviations;  ///< of the volume's vertices [m]; empty: not estimated
  double volume_edge_m;                  ///< mean length of the volume's edges
};

/// Admits new features to the map where the visible surface has few. The first ones are admitted at once;
/// later ones tile by tile, so that no frame takes much longer than others.
class FeatureAdmission {
 public:
  /// @param most features in view.
  explicit FeatureAdmission(int most) : most_(most) {}

  void setMost(int most) { most_ = most; }

  /// Admits new features if this is due.
  void admit(const LearnedFrame& from, FeatureMap* map);

  /// To be called when the body was edited. New surface may be visible, so tiles are searched at the full
  /// rate again.
  void bodyEdited() { rounds_.reset(); }
  void reset();

 private:
  int enoughFeatures(double visible_vertices) const;
  cv::Rect nextTile(const cv::Rect& covered);
  void admitIn(const LearnedFrame& from, int room, FeatureMap* map);

  /// Of surface that shows no new feature [ns]: its tiles then cost as little as one in ten frames.
  static constexpr Nanoseconds kLongestWait = 1'000'000'000;

  int most_;
  OrbExtractor orb_;
  Backoff rounds_{kLongestWait};  ///< of all tiles, without a new feature
  int fruitless_tiles_ = 0;       ///< consecutive tiles without a new feature
  int tile_ = 0;                  ///< the tile of the surface that was searched last
};

}  // namespace softbody
