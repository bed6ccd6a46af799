#include <gtest/gtest.h>

#include <random>
#include <set>

#include "core/feature_map.h"
#include "softbody_common/rigid_fit.h"
#include "synthetic_scene.h"

namespace softbody {
namespace {

constexpr double kReach = 0.04;  // [m]

/// A map bound to the box in its first pose.
class FeatureMapTest : public ::testing::Test {
 protected:
  FeatureMapTest() : surface_(box_.volume, box_.surface), orb_(1000), map_(FeatureConfig()) {
    look(transformed(box_.volume.rest_vertices, boxPose()));
    map_.admit(frame_, image_, keypoints_, surface_, {true});
  }

  /// Renders the box at the vertices and predicts it there, moved by an error.
  void look(const Points& truth, const Eigen::Vector3d& prediction_error = Eigen::Vector3d::Zero()) {
    frame_ = renderFrame(box_, truth, 1);
    surface_.update(frame_.camera,
                    transformed(truth, Eigen::Isometry3d(Eigen::Translation3d(prediction_error))));
    image_.build(frame_.color, cv::Rect(cv::Point(), frame_.color.size()));
    keypoints_ = orb_.extract(frame_.color, cv::Mat1b(frame_.color.size(), 255), surface_.image().region);
  }

  std::vector<FeatureMatch> some(int wanted) {
    std::vector<FeatureMatch> matches;
    map_.align(frame_, image_, wanted, &matches);
    return matches;
  }

  std::vector<FeatureMatch> align() {
    map_.predict(frame_, colors_, kReach, surface_);
    std::vector<FeatureMatch> matches = some(FeatureMap::kAll);
    markOutliers(frame_.camera, FeatureConfig().max_disagreement_m, &matches);
    map_.credit(matches, {true});
    return matches;
  }

  BoxBody box_ = makeBox();
  PredictedSurface surface_;
  ColorModel colors_;
  GrayPyramid image_;
  OrbExtractor orb_;
  FeatureMap map_;
  RgbdFrame frame_;
  std::vector<Keypoint> keypoints_;
};

TEST_F(FeatureMapTest, BindsFeaturesWhereTheirPixelsSeeTheBody) {
  ASSERT_GT(map_.features().size(), 200u);
  for (const MapFeature& feature : map_.features()) {
    EXPECT_LT((surface_.position(feature.place) - feature.reference).norm(), 0.003);
    EXPECT_NEAR(feature.place.barycentric.sum(), 1.0, 1e-9);
  }
}

TEST_F(FeatureMapTest, FindsThemAgainWithSubPixelPrecision) {
  const Points truth =
      transformed(box_.volume.rest_vertices, Eigen::Translation3d(0.004, -0.002, 0.003) * boxPose() *
                                                 Eigen::AngleAxisd(0.05, Eigen::Vector3d::UnitZ()));
  look(truth, {0.003, 0.002, 0.0});
  const std::vector<FeatureMatch> matches = align();
  ASSERT_GT(matches.size(), 100u);
  EXPECT_GT(matches.size(), 0.5 * map_.expected());
  std::vector<double> errors;
  for (const FeatureMatch& match : matches) {
    const Eigen::Vector2d pixel =
        frame_.camera.project(positionOf(match.association.place, truth, box_.volume.tets));
    errors.push_back((pixel - Eigen::Vector2d(match.pixel.x, match.pixel.y)).norm());
  }
  std::sort(errors.begin(), errors.end());
  // The checkered test texture is not anti-aliased: it moves by whole pixels itself.
  EXPECT_LT(errors[errors.size() / 2], 0.3);
  EXPECT_LT(errors[errors.size() * 9 / 10], 1.0);
}

TEST_F(FeatureMapTest, SomeAreSpreadOverAll) {
  map_.predict(frame_, colors_, kReach, surface_);
  const std::vector<FeatureMatch> first = some(40), rest = some(FeatureMap::kAll);
  EXPECT_NEAR(static_cast<double>(first.size()), 40.0, 10.0);
  EXPECT_GT(first.back().feature - first.front().feature, 3 * map_.expected() / 4);
  std::set<int> features;
  for (const std::vector<FeatureMatch>* matches : {&first, &rest}) {
    for (const FeatureMatch& match : *matches)
      EXPECT_TRUE(features.insert(match.feature).second) << "a feature is tried twice";
  }
  EXPECT_GT(features.size(), 0.8 * map_.expected());
  EXPECT_TRUE(some(FeatureMap::kAll).empty()) << "all have been tried";
}

/// Where the prediction is far off, its rigid motion says where full resolution finds the patches.
TEST_F(FeatureMapTest, ShiftedPredictionsStartWhereTheMotionTakesThem) {
  const Eigen::Vector3d error(0.02, 0.0, 0.0);  // beyond the window
  look(transformed(box_.volume.rest_vertices, boxPose()), error);
  EXPECT_LT(align().size(), 0.2 * map_.features().size());
  map_.predict(frame_, colors_, kReach, surface_);
  map_.shift(frame_.camera, {Eigen::Isometry3d(Eigen::Translation3d(-error))});
  const std::vector<FeatureMatch> found = some(FeatureMap::kAll);
  EXPECT_GT(found.size(), 0.8 * map_.expected());
  for (const FeatureMatch& match : found) {
    EXPECT_LT((surface_.position(match.association.place) - match.association.predicted).norm(), 1e-9)
        << "the prediction itself stays";
  }
}

/// What is covered is not missed: it is not expected, and does not count against a feature's merit.
TEST_F(FeatureMapTest, CoveredFeaturesAreNotExpected) {
  align();
  const int expected = map_.expected();
  const cv::Rect covered(0, 0, surface_.image().region.x + surface_.image().region.width / 2, 480);
  frame_.depth(covered).setTo(0.3f);
  frame_.color(covered).setTo(cv::Vec3b(90, 90, 90));
  image_.build(frame_.color, cv::Rect(cv::Point(), frame_.color.size()));
  for (int i = 0; i < 60; ++i) {
    const std::vector<FeatureMatch> found = align();
    EXPECT_GT(found.size(), 0.8 * map_.expected());
  }
  EXPECT_LT(map_.expected(), 0.8 * expected);
  const std::size_t known = map_.features().size();
  map_.admit(frame_, image_, {}, surface_, {true});
  EXPECT_GT(map_.features().size(), 0.9 * known) << "the covered ones stay";
}

/// A tool's depth is taken out; that there is none does not say that the features should have been found.
TEST_F(FeatureMapTest, FeaturesUnderAKnownToolAreNotExpected) {
  align();
  const int expected = map_.expected();
  const cv::Rect tool(0, 0, surface_.image().region.x + surface_.image().region.width / 2, 480);
  frame_.depth(tool).setTo(0.0f);
  frame_.color(tool).setTo(cv::Vec3b(90, 90, 90));
  image_.build(frame_.color, cv::Rect(cv::Point(), frame_.color.size()));
  align();
  EXPECT_EQ(map_.expected(), expected) << "nothing says what a hole in the depth image is";
  frame_.covered = cv::Mat1b(frame_.depth.size(), 0);
  frame_.covered(tool).setTo(255);
  const std::vector<FeatureMatch> found = align();
  EXPECT_GT(found.size(), 0.8 * map_.expected());
  EXPECT_LT(map_.expected(), 0.8 * expected);
}

TEST_F(FeatureMapTest, DescriptorsFindWhatMovedTooFarForThePatches) {
  const Points truth = transformed(box_.volume.rest_vertices, boxPose());
  look(truth, {0.013, 0.0, 0.0});
  std::vector<FeatureMatch> matches = align();
  const std::size_t aligned = matches.size();
  map_.search(frame_, image_, keypoints_, surface_, &matches);
  EXPECT_GT(matches.size(), aligned + 50);
  std::set<int> found;
  for (const FeatureMatch& match : matches)
    EXPECT_TRUE(found.insert(match.feature).second) << "a feature is matched twice";
}

TEST_F(FeatureMapTest, MarksMatchesThatDisagreeWithTheirNeighbors) {
  const cv::Mat1f true_depth = frame_.depth.clone();
  std::mt19937 random(8);
  std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
  // Wrong depth around every tenth keypoint.
  for (const Keypoint& keypoint : keypoints_) {
    if (uniform(random) > 0.1f) continue;
    const cv::Rect spot = cv::Rect(cvRound(keypoint.pixel.x) - 2, cvRound(keypoint.pixel.y) - 2, 5, 5) &
                          cv::Rect(cv::Point(), frame_.depth.size());
    frame_.depth(spot) = true_depth(spot) + 0.02f;
  }
  int wrong_inliers = 0, right_outliers = 0, wrong = 0;
  for (const FeatureMatch& match : align()) {
    const bool is_wrong = (match.association.measured - match.association.predicted).norm() > 0.015;
    wrong += is_wrong ? 1 : 0;
    wrong_inliers += is_wrong && match.inlier ? 1 : 0;
    right_outliers += !is_wrong && !match.inlier ? 1 : 0;
  }
  EXPECT_GT(wrong, 10);
  EXPECT_EQ(wrong_inliers, 0);
  EXPECT_LT(right_outliers, 30);
}

TEST_F(FeatureMapTest, AdmitsNothingTwiceAndDropsWhatIsNeverFoundAgain) {
  const std::size_t bound = map_.features().size();
  cv::Mat1b free(frame_.color.size(), 255);
  map_.eraseTaken(align(), &free);
  map_.admit(frame_, image_, orb_.extract(frame_.color, free, surface_.image().region), surface_, {true});
  EXPECT_LT(map_.features().size(), bound + bound / 5) << "the surface was covered with features already";
  frame_.color.setTo(cv::Vec3b(90, 90, 90));
  image_.build(frame_.color, cv::Rect(cv::Point(), frame_.color.size()));
  for (int i = 0; i < 400; ++i) EXPECT_TRUE(align().empty());
  map_.admit(frame_, image_, {}, surface_, {true});
  EXPECT_TRUE(map_.features().empty());
}

TEST_F(FeatureMapTest, LearnsNothingOfAPieceThatHardlyShows) {
  FeatureMap none{FeatureConfig()};
  none.admit(frame_, image_, keypoints_, surface_, {false});
  EXPECT_TRUE(none.features().empty());
  const std::vector<FeatureMatch> matches = align();
  const std::vector<MapFeature> before = map_.features();
  map_.credit(matches, {false});
  for (std::size_t f = 0; f < before.size(); ++f) {
    EXPECT_EQ(map_.features()[f].predicted, before[f].predicted);
    EXPECT_EQ(map_.features()[f].matched, before[f].matched);
  }
}

TEST_F(FeatureMapTest, HoldsNoMoreThanAsked) {
  FeatureConfig config;
  config.max_features = 50;
  FeatureMap small(config);
  small.admit(frame_, image_, keypoints_, surface_, {true});
  EXPECT_EQ(small.features().size(), 50u);
}

TEST(FeatureDepth, AveragesSurfacesAndRefusesEdgesAndHoles) {
  cv::Mat1f depth(20, 20, 0.5f);
  EXPECT_NEAR(featureDepth(depth, {10.0f, 10.0f}), 0.5, 1e-6);
  depth.colRange(11, 20).setTo(0.8f);
  EXPECT_EQ(featureDepth(depth, {10.0f, 10.0f}), 0.0);
  EXPECT_EQ(featureDepth(cv::Mat1f(20, 20, 0.0f), {10.0f, 10.0f}), 0.0);
  EXPECT_EQ(featureDepth(depth, {-5.0f, 300.0f}), 0.0);
}

TEST(OrbExtractor, FindsNothingWhereNothingIs) {
  OrbExtractor orb(100);
  EXPECT_TRUE(
      orb.extract(cv::Mat3b(200, 200, cv::Vec3b(50, 50, 50)), cv::Mat1b(200, 200, 255), {0, 0, 200, 200})
          .empty());
  EXPECT_TRUE(orb.extract(cv::Mat3b(40, 40, cv::Vec3b()), cv::Mat1b(40, 40, 255), {0, 0, 10, 10}).empty());
  EXPECT_TRUE(
      OrbExtractor(0).extract(cv::Mat3b(200, 200), cv::Mat1b(200, 200, 255), {0, 0, 200, 200}).empty());
}

TEST(HammingDistance, CountsDifferingBits) {
  std::mt19937_64 random(9);
  for (int trial = 0; trial < 100; ++trial) {
    const Descriptor a{random(), random(), random(), random()};
    Descriptor b = a;
    EXPECT_EQ(hammingDistance(a, b), 0);
    b[trial % 4] ^= (1ULL << (trial % 64)) | (1ULL << ((trial + 1) % 64));
    EXPECT_EQ(hammingDistance(a, b), 2);
    EXPECT_EQ(hammingDistance(b, a), 2);
  }
}

}  // namespace
}  // namespace softbody
