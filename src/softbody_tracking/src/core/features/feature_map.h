#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "features/feature_match.h"
#include "features/feature_patch.h"
#include "features/gray_pyramid.h"
#include "features/orb_extractor.h"
#include "prediction/association.h"
#include "prediction/color_model.h"
#include "prediction/predicted_surface.h"
#include "softbody_tracking/rgbd_frame.h"
#include "softbody_tracking/tracker_config.h"

namespace softbody {

/// How far from the prediction a descriptor is looked for where patches are not found [px].
constexpr int kWideSearchPx = 64;

/// With so many expected, hardly any found says something.
constexpr int kFewestExpectedFeatures = 30;

/// Where a feature lies, and how that changes in the image that its patch is from.
struct FeaturePlace {
  MaterialPoint place;
  PlaceGradient gradient = PlaceGradient::Zero();
};

/// A feature bound to the body, with its descriptor as first seen.
struct MapFeature : FeaturePlace {
  int id = 0;
  Descriptor descriptor{};
  FeaturePatch patch;
  FeaturePlace first;                                   ///< as it was bound when admitted,
  Eigen::Matrix4d first_tet = Eigen::Matrix4d::Zero();  ///< that tet's corners at rest, homogeneous [m],
  Eigen::Index first_vertices = 0;                      ///< and how many vertices the body had
  Eigen::Vector3d reference = Eigen::Vector3d::Zero();  ///< measured position when bound, fixed frame [m]
  int predicted = 0;                                    ///< frames in which it should have been seen
  int matched = 0;                                      ///< frames in which it was
};

/// ORB features bound to the body where they lie and found again around their predicted positions: by
/// aligning their patches with sub-pixel precision, and those that moved too far for it by their descriptors.
class FeatureMap {
 public:
  static constexpr int kAll = std::numeric_limits<int>::max();

  explicit FeatureMap(const FeatureConfig& config) : config_(config) {}

  const std::vector<MapFeature>& features() const { return features_; }

  /// Says which features should be visible, and where. Those that something else stands before are not
  /// expected.
  /// @param reach_m what is nearer to the camera than predicted by more is something else, whatever its
  /// colour.
  void predict(const RgbdFrame& frame, const ColorModel& colors, double reach_m,
               const PredictedSurface& surface);

  /// Looks for the features where the motions of the body's pieces take the prediction.
  void shift(const Pinhole& camera, const RigidMotions& motions);

  /// Aligns the patches of the predicted features that have not been tried since predict() or shift().
  /// @param wanted about so many of all, spread evenly; at least 1. @param matches those found are added.
  void align(const RgbdFrame& frame, const GrayPyramid& image, int wanted,
             std::vector<FeatureMatch>* matches);

  /// Adds matches, by descriptor and then aligned, of the visible features that align() did not find.
  void search(const RgbdFrame& frame, const GrayPyramid& image, const std::vector<Keypoint>& keypoints,
              const PredictedSurface& surface, std::vector<FeatureMatch>* matches);

  /// Remembers which of the predicted features were found again. @param shown of each piece: features of one
  /// that hardly shows are held in no esteem for it, good or bad.
  void credit(const std::vector<FeatureMatch>& matches, const std::vector<bool>& shown);

  /// Of the features that the last predict() found on visible surface, the share that nothing stands before;
  /// 1 where there are none.
  double uncoveredShare() const;

  /// How many features the last predict() expected to see.
  int expected() const { return static_cast<int>(predictions_.size()); }
  /// How many of them on some of the pieces. @param counted of each piece.
  int expected(const std::vector<bool>& counted) const;

  /// Sets a mask of the image to 0 around known features, those found and those that were not where they
  /// should be: no corners need be ranked there.
  void eraseTaken(const std::vector<FeatureMatch>& matches, cv::Mat1b* mask) const;

  /// How many more features may be admitted in this view.
  int room() const;

  /// Of corners those that can be bound: of the first view most of them among the strongest, later those
  /// where features are few.
  /// @param ranked away from known features: see eraseTaken(); the best first. @param shown of each piece:
  /// nothing is learned of others. @param gap_m see spreadStrong() and spreadOut().
  std::vector<cv::KeyPoint> choose(const RgbdFrame& frame, const std::vector<cv::KeyPoint>& ranked,
                                   const PredictedSurface& surface, const std::vector<bool>& shown,
                                   int wanted, double gap_m) const;

  /// Binds keypoints on visible surface of pieces that show, as many as there is room for.
  void admit(const RgbdFrame& frame, const GrayPyramid& image, const std::vector<Keypoint>& keypoints,
             const PredictedSurface& surface, const std::vector<bool>& shown);

  /// Drops features that are hardly ever found again.
  void retire();

  /// Takes the features to an edited body. Those on the wall of a cut stay on their side; where an edit
  /// brings back the body in which a feature was admitted, the feature's place is what it was then, bit by
  /// bit.
  void rebind(const TetTopology& before, const TetTopology& after);

  void reset();

 private:
  /// A feature that should be seen, and where.
  struct Prediction {
    int feature = 0;
    cv::Point2f pixel;
    std::uint32_t body = 0;
    Eigen::Vector3d position;
    Eigen::Matrix2f warp;
    bool tried = false;
  };

  std::optional<FeaturePatch::Alignment> locate(const GrayPyramid& image, const Prediction& prediction,
                                                const cv::Point2f& start, int coarsest_level,
                                                int radius_px) const;
  bool addMatch(const RgbdFrame& frame, const GrayPyramid& image, const Prediction& prediction,
                const cv::Point2f& start, int radius_px, std::vector<FeatureMatch>* matches) const;

  FeatureConfig config_;
  std::vector<MapFeature> features_;
  std::vector<Prediction> predictions_;
  std::vector<Prediction> missed_;  ///< by align()
  int covered_ = 0;                 ///< features, at the last predict()
  int next_id_ = 0;
};

/// Depth at a keypoint [m]: mean over the 5x5 pixels that lie within 2 % of the middle one; 0 where there is
/// none.
double featureDepth(const cv::Mat1f& depth, const cv::Point2f& pixel);

}  // namespace softbody
