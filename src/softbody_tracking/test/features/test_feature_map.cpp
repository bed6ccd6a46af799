#include <gtest/gtest.h>

#include <algorithm>
#include <bitset>
#include <random>
#include <set>

#include "features/feature_map.h"
#include "fixtures/synthetic_scene.h"
#include "softbody_common/rigid_fit.h"

namespace softbody {
namespace {

constexpr double kReach = 0.04;  // [m]
constexpr double kGap = 0.005;   // [m]

/// A map bound to the box in its first pose.
class FeatureMapTest : public ::testing::Test {
 protected:
  FeatureMapTest() : surface_(box_.volume, box_.surface), map_(FeatureConfig()) {
    look(transformed(box_.volume.rest_vertices, boxPose()));
    map_.admit(frame_, image_, chosen(map_), surface_, {true});
  }

  /// Renders the box at the vertices and predicts it there, moved by an error.
  void look(const Points& truth, const Eigen::Vector3d& prediction_error = Eigen::Vector3d::Zero()) {
    frame_ = renderFrame(box_, truth, 1);
    surface_.update(frame_.camera,
                    transformed(truth, Eigen::Isometry3d(Eigen::Translation3d(prediction_error))));
    image_.build(frame_.color, cv::Rect(cv::Point(), frame_.color.size()));
  }

  /// All of the image.
  std::vector<Keypoint> keypoints() {
    return orb_.extract(frame_.color, cv::Mat1b(frame_.color.size(), 255), surface_.image().region);
  }

  /// Those that a map would take.
  std::vector<Keypoint> chosen(const FeatureMap& map, const cv::Mat1b& free) {
    const cv::Rect& region = surface_.image().region;
    const std::vector<cv::KeyPoint> corners = orb_.detect(frame_.color, free, region);
    return orb_.describe(frame_.color, region,
                         map.choose(frame_, corners, surface_, {true}, map.room(), kGap));
  }
  std::vector<Keypoint> chosen(const FeatureMap& map) {
    return chosen(map, cv::Mat1b(frame_.color.size(), 255));
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
  map_.retire();
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
  map_.search(frame_, image_, keypoints(), surface_, &matches);
  EXPECT_GT(matches.size(), aligned + 50);
  std::set<int> found;
  for (const FeatureMatch& match : matches)
    EXPECT_TRUE(found.insert(match.feature).second) << "a feature is matched twice";
}

TEST_F(FeatureMapTest, MarksMatchesThatDisagreeWithTheirNeighbors) {
  const cv::Mat1f true_depth = frame_.depth.clone();
  std::mt19937 random(8);
  std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
  // Wrong depth around every tenth feature.
  for (const FeatureMatch& match : align()) {
    if (uniform(random) > 0.1f) continue;
    const cv::Rect spot = cv::Rect(cvRound(match.pixel.x) - 2, cvRound(match.pixel.y) - 2, 5, 5) &
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
  map_.admit(frame_, image_, chosen(map_, free), surface_, {true});
  EXPECT_LT(map_.features().size(), bound + bound / 5) << "the surface was covered with features already";
  frame_.color.setTo(cv::Vec3b(90, 90, 90));
  image_.build(frame_.color, cv::Rect(cv::Point(), frame_.color.size()));
  for (int i = 0; i < 400; ++i) EXPECT_TRUE(align().empty());
  map_.retire();
  EXPECT_TRUE(map_.features().empty());
}

TEST_F(FeatureMapTest, LearnsNothingOfAPieceThatHardlyShows) {
  FeatureMap none{FeatureConfig()};
  none.admit(frame_, image_, keypoints(), surface_, {false});
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
  small.admit(frame_, image_, keypoints(), surface_, {true});
  EXPECT_EQ(small.features().size(), 50u);
}

/// Another side that comes into view gets as many as the first.
TEST_F(FeatureMapTest, HoldsSoManyInEveryView) {
  FeatureConfig config;
  config.max_features = 40;
  FeatureMap small(config);
  std::size_t known = 0;
  for (int view = 0; view < 6; ++view) {
    const Eigen::Vector3d axis = view < 4 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
    look(
        transformed(box_.volume.rest_vertices, boxPose() * Eigen::AngleAxisd(0.5 * M_PI * view + 0.1, axis)));
    small.predict(frame_, colors_, kReach, surface_);
    const int before = small.expected(), room = small.room();
    small.admit(frame_, image_, chosen(small), surface_, {true});
    EXPECT_LE(small.features().size(), known + room);
    if (view == 2) {
      EXPECT_GT(small.features().size(), 75u) << "the first views' features are out of view";
    }
    known = small.features().size();
    small.predict(frame_, colors_, kReach, surface_);
    EXPECT_LE(small.expected(), std::max(40, before));
  }
}

TEST_F(FeatureMapTest, KeepsFourTimesAsManyAsMayBeInView) {
  FeatureConfig config;
  config.max_features = 40;
  FeatureMap small(config);
  for (const std::size_t kept : {40u, 80u, 120u, 160u, 160u}) {
    small.admit(frame_, image_, keypoints(), surface_, {true});
    EXPECT_EQ(small.features().size(), kept) << "of what was admitted before, nothing is expected in view";
  }
  EXPECT_EQ(small.room(), 0);
}

TEST_F(FeatureMapTest, ChoosesCornersOnTheBodyWhereFeaturesAreFew) {
  const cv::Rect& region = surface_.image().region;
  const std::vector<cv::KeyPoint> corners =
      orb_.detect(frame_.color, cv::Mat1b(frame_.color.size(), 255), region);
  FeatureMap half{FeatureConfig()};
  const auto is_left = [&](const cv::KeyPoint& corner) { return corner.pt.x < region.x + region.width / 2; };
  std::vector<cv::KeyPoint> left;
  std::copy_if(corners.begin(), corners.end(), std::back_inserter(left), is_left);
  half.admit(frame_, image_, orb_.describe(frame_.color, region, left), surface_, {true});
  half.predict(frame_, colors_, kReach, surface_);
  const std::vector<cv::KeyPoint> chosen = half.choose(frame_, corners, surface_, {true}, 50, kGap);
  ASSERT_EQ(chosen.size(), 50u);
  EXPECT_LT(std::count_if(chosen.begin(), chosen.end(), is_left), 5);
  for (const cv::KeyPoint& corner : chosen)
    EXPECT_GT(surface_.image().depth(cv::Point(cvRound(corner.pt.x), cvRound(corner.pt.y))), 0.0f);
  EXPECT_TRUE(half.choose(frame_, corners, surface_, {false}, 50, kGap).empty());
}

TEST(FeatureDepth, AveragesSurfacesAndRefusesEdgesAndHoles) {
  cv::Mat1f depth(20, 20, 0.5f);
  EXPECT_NEAR(featureDepth(depth, {10.0f, 10.0f}), 0.5, 1e-6);
  depth.colRange(11, 20).setTo(0.8f);
  EXPECT_EQ(featureDepth(depth, {10.0f, 10.0f}), 0.0);
  EXPECT_EQ(featureDepth(cv::Mat1f(20, 20, 0.0f), {10.0f, 10.0f}), 0.0);
  EXPECT_EQ(featureDepth(depth, {-5.0f, 300.0f}), 0.0);
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
    const Descriptor c{random(), random(), random(), random()}, none{};
    int bits = 0;
    for (int k = 0; k < 4; ++k) bits += static_cast<int>(std::bitset<64>(a[k] ^ c[k]).count());
    EXPECT_EQ(hammingDistance(a, c), bits);
    EXPECT_EQ(hammingDistance(none, {~0ull, ~0ull, ~0ull, ~0ull}), 256);
  }
}

}  // namespace
}  // namespace softbody
