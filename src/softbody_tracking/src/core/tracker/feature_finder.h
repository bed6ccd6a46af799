#pragma once

#include <vector>

#include "features/feature_matching.h"
#include "features/feature_recognition.h"
#include "features/orb_extractor.h"
#include "labels/region_colors.h"
#include "patches/gray_pyramid.h"
#include "prediction/predicted_surface.h"

namespace softbody {

/// The features that are looked for in a frame.
struct SoughtFeatures {
  const RgbdFrame& frame;
  const std::vector<MapFeature>& known;
  const RegionColors& colors;
  /// For each piece: true if its features are expected at their predicted places; false for a piece that is
  /// held.
  std::vector<bool> followed;
};

/// The features that a frame shows around a predicted surface.
struct FoundFeatures {
  ExpectedFeatures expected;
  FeatureMatches found;
  GrayPyramid image;  ///< grey image of the frame around the surface
};

/// Finds known features in a frame. It keeps nothing from one call to the next.
class FeatureFinder {
 public:
  /// The features that the frame should show. None is looked for yet.
  FoundFeatures expect(const SoughtFeatures& sought, const PredictedSurface& surface,
                       const Labels& labels) const;

  /// Finds all by aligning their patches around the expected pixels. Outliers are not marked.
  FoundFeatures findAll(const SoughtFeatures& sought, FoundFeatures expected) const;

  /// Finds a few, as scouts.
  FoundFeatures findScouts(const SoughtFeatures& sought, FoundFeatures expected) const;
  /// Whether the scouts show that the prediction is far off.
  static bool areFarOff(const SoughtFeatures& sought, const FoundFeatures& scouts);
  /// Adds the features that are no scouts, and marks outliers.
  FoundFeatures findOthers(const SoughtFeatures& sought, FoundFeatures scouts) const;
  /// Finds all where the motions of the pieces take them, and marks outliers.
  FoundFeatures findAfter(const SoughtFeatures& sought, const RigidMotions& motions,
                          FoundFeatures expected) const;

  /// Adds missed features that are found by their descriptors in a wide window, and marks outliers.
  FoundFeatures addFromAfar(const SoughtFeatures& sought, const PredictedSurface& surface,
                            FoundFeatures features) const;

  /// Pairs features with keypoints of the whole image, where it has the body's colours. @param vertices of
  /// the volume, as expected.
  std::vector<PointPair> recognize(const SoughtFeatures& sought, const SurfaceModel& model,
                                   const Points& vertices) const;

 private:
  OrbExtractor orb_;
};

}  // namespace softbody
