#include <gtest/gtest.h>

#include <algorithm>
#include <bitset>
#include <memory>
#include <random>
#include <set>

#include "features/feature_map.h"
#include "features/feature_matching.h"
#include "features/feature_outliers.h"
#include "features/feature_selection.h"
#include "fixtures/labels_at.h"
#include "fixtures/synthetic_scene.h"
#include "softbody_common/geometry/rigid_fit.h"
#include "softbody_tracking/tracker_config.h"

namespace softbody {
namespace {

constexpr double kGap = 0.005;  // [m]

/// A map bound to the box in its first pose.
class FeatureMapTest : public ::testing::Test {
 protected:
  FeatureMapTest() { admit(chosen(map_), &map_); }

  /// Renders the box at the vertices, and the prediction there with an error.
  void show(const Points& truth, const Eigen::Vector3d& prediction_error = Eigen::Vector3d::Zero()) {
    frame_ = renderFrame(box_, truth, 1);
    surface_ = {model_, frame_.camera,
                transformed(truth, Eigen::Isometry3d(Eigen::Translation3d(prediction_error))), &memory_};
    image_ = wholeImage();
  }
  GrayPyramid wholeImage() const { return {frame_.color, cv::Rect(cv::Point(), frame_.color.size())}; }

  /// Keypoints of the whole image.
  std::vector<Keypoint> keypoints() {
    return orb_.extract(frame_.color, cv::Mat1b(frame_.color.size(), 255), surface_.image().region);
  }

  KnownPlaces placesOf(const FeatureMap& map, const ExpectedFeatures& expected) const {
    KnownPlaces known;
    known.first_view = map.features().empty();
    for (const ExpectedFeature& f : expected.visible) known.places.push_back(map.features()[f.feature].place);
    return known;
  }

  /// Keypoints that a map would take. @param expected features of the map in this view.
  std::vector<Keypoint> chosen(const FeatureMap& map, const cv::Mat1b& free,
                               const ExpectedFeatures& expected) {
    const cv::Rect& region = surface_.image().region;
    const std::vector<cv::KeyPoint> corners = orb_.detect(frame_.color, free, region);
    return orb_.describe(frame_.color, region,
                         chooseCorners(frame_, corners, surface_, {true}, placesOf(map, expected),
                                       map.room(expected.count()), kGap));
  }
  std::vector<Keypoint> chosen(const FeatureMap& map, const ExpectedFeatures& expected = {}) {
    return chosen(map, cv::Mat1b(frame_.color.size(), 255), expected);
  }

  void admit(const std::vector<Keypoint>& keypoints, FeatureMap* map, int expected = 0,
             bool learnable = true) {
    map->add(bindKeypoints(frame_, image_, keypoints, surface_, {learnable}, map->room(expected)));
  }

  ExpectedFeatures expect(const FeatureMap& map) const {
    return expectFeatures(map.features(), labelsAt(frame_, surface_), surface_);
  }
  FeatureMatcher matcher() const { return {map_.features(), frame_, image_}; }

  struct Found {
    ExpectedFeatures expected;
    FeatureMatches all;
  };

  /// Expected features, aligned and scored.
  Found align() {
    Found found{expect(map_), {}};
    found.all = matcher().alignAll(found.expected);
    markOutliers(frame_.camera, &found.all.matches);
    map_.score(found.expected, found.all.matches, {true}, 1.0 / 30.0);
    return found;
  }

  BoxBody box_ = makeBox();
  std::shared_ptr<const SurfaceModel> model_ = std::make_shared<SurfaceModel>(box_.volume, box_.surface);
  RgbdFrame frame_ = renderFrame(box_, transformed(box_.volume.rest_vertices, boxPose()), 1);
  RasterMemory memory_;
  PredictedSurface surface_{model_, frame_.camera, transformed(box_.volume.rest_vertices, boxPose()),
                            &memory_};
  GrayPyramid image_ = wholeImage();
  OrbExtractor orb_;
  FeatureMap map_{TrackerConfig().max_features};
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
  show(truth, {0.003, 0.002, 0.0});
  const Found found = align();
  const std::vector<FeatureMatch>& matches = found.all.matches;
  ASSERT_GT(matches.size(), 100u);
  EXPECT_GT(matches.size(), 0.5 * found.expected.count());
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
  const ExpectedFeatures expected = expect(map_);
  const FeatureMatches some = matcher().alignSome(expected, 40);
  EXPECT_NEAR(static_cast<double>(some.matches.size()), 40.0, 10.0);
  EXPECT_GT(some.matches.back().feature - some.matches.front().feature, 3 * expected.count() / 4);
  const FeatureMatches all = matcher().alignOthers(expected, 40, some);
  EXPECT_EQ(all.matches.size() + all.missed.size(), expected.visible.size());
  std::set<int> features;
  for (const FeatureMatch& match : all.matches)
    EXPECT_TRUE(features.insert(match.feature).second) << "a feature is tried twice";
  EXPECT_GT(features.size(), 0.8 * expected.count());
}

/// If the prediction is far off, its rigid motion gives places where full resolution finds the patches.
TEST_F(FeatureMapTest, ShiftedPredictionsStartWhereTheMotionTakesThem) {
  const Eigen::Vector3d error(0.02, 0.0, 0.0);  // beyond the window
  show(transformed(box_.volume.rest_vertices, boxPose()), error);
  EXPECT_LT(align().all.matches.size(), 0.2 * map_.features().size());
  const ExpectedFeatures expected =
      lookedForAfter({Eigen::Isometry3d(Eigen::Translation3d(-error))}, frame_.camera, expect(map_));
  const FeatureMatches found = matcher().alignAll(expected);
  EXPECT_GT(found.matches.size(), 0.8 * expected.count());
  for (const FeatureMatch& match : found.matches) {
    EXPECT_LT((surface_.position(match.association.place) - match.association.predicted).norm(), 1e-9)
        << "the prediction itself stays";
  }
}

/// A covered feature is not expected, and this does not reduce its score.
TEST_F(FeatureMapTest, CoveredFeaturesAreNotExpected) {
  const int expected = align().expected.count();
  int left = expected;
  const cv::Rect covered(0, 0, surface_.image().region.x + surface_.image().region.width / 2, 480);
  frame_.depth(covered).setTo(0.3f);
  frame_.color(covered).setTo(cv::Vec3b(90, 90, 90));
  image_ = wholeImage();
  for (int i = 0; i < 60; ++i) {
    const Found found = align();
    left = found.expected.count();
    EXPECT_GT(found.all.matches.size(), 0.8 * left);
  }
  EXPECT_LT(left, 0.8 * expected);
  const std::size_t known = map_.features().size();
  map_.retire();
  EXPECT_GT(map_.features().size(), 0.9 * known) << "the covered ones stay";
}

/// The depth of a known tool is erased. Missing depth alone does not mean that the features are covered.
TEST_F(FeatureMapTest, FeaturesUnderAKnownToolAreNotExpected) {
  const int expected = align().expected.count();
  const cv::Rect tool(0, 0, surface_.image().region.x + surface_.image().region.width / 2, 480);
  frame_.depth(tool).setTo(0.0f);
  frame_.color(tool).setTo(cv::Vec3b(90, 90, 90));
  image_ = wholeImage();
  EXPECT_EQ(align().expected.count(), expected) << "nothing says what a hole in the depth image is";
  frame_.covered = cv::Mat1b(frame_.depth.size(), 0);
  frame_.covered(tool).setTo(255);
  const Found found = align();
  EXPECT_GT(found.all.matches.size(), 0.8 * found.expected.count());
  EXPECT_LT(found.expected.count(), 0.8 * expected);
}

TEST_F(FeatureMapTest, DescriptorsFindWhatMovedTooFarForThePatches) {
  const Points truth = transformed(box_.volume.rest_vertices, boxPose());
  show(truth, {0.013, 0.0, 0.0});
  const FeatureMatches aligned = align().all;
  const std::vector<FeatureMatch> more = matcher().matchDescriptors(aligned.missed, keypoints());
  EXPECT_GT(more.size(), 50u);
  std::set<int> found;
  for (const std::vector<FeatureMatch>* matches : {&aligned.matches, &more}) {
    for (const FeatureMatch& match : *matches)
      EXPECT_TRUE(found.insert(match.feature).second) << "a feature is matched twice";
  }
}

TEST_F(FeatureMapTest, MarksMatchesThatDisagreeWithTheirNeighbors) {
  const cv::Mat1f true_depth = frame_.depth.clone();
  std::mt19937 random(8);
  std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
  // Wrong depth around every tenth feature.
  for (const FeatureMatch& match : align().all.matches) {
    if (uniform(random) > 0.1f) continue;
    const cv::Rect spot = cv::Rect(cvRound(match.pixel.x) - 2, cvRound(match.pixel.y) - 2, 5, 5) &
                          cv::Rect(cv::Point(), frame_.depth.size());
    frame_.depth(spot) = true_depth(spot) + 0.02f;
  }
  int wrong_inliers = 0, right_outliers = 0, wrong = 0;
  for (const FeatureMatch& match : align().all.matches) {
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
  const Found found = align();
  const cv::Mat1b free = withoutKnownFeatures(cv::Mat1b(frame_.color.size(), 255), found.all);
  admit(chosen(map_, free, found.expected), &map_, found.expected.count());
  EXPECT_LT(map_.features().size(), bound + bound / 5) << "the surface was covered with features already";
  frame_.color.setTo(cv::Vec3b(90, 90, 90));
  image_ = wholeImage();
  for (int i = 0; i < 400; ++i) EXPECT_TRUE(align().all.matches.empty());
  map_.retire();
  EXPECT_TRUE(map_.features().empty());
}

TEST_F(FeatureMapTest, TriesFeaturesForTheSameTimeAtAnyRate) {
  const ExpectedFeatures expected = expect(map_);
  const FeatureMap fresh = map_;
  for (const int rate : {15, 30, 60}) {
    map_ = fresh;
    for (int i = 0; i < rate; ++i) {
      EXPECT_EQ(map_.features().empty(), i > 0.7 * rate + 1.0) << i << " of " << rate;
      map_.score(expected, {}, {true}, 1.0 / rate);
      if (i < 0.55 * rate || i > 0.7 * rate) map_.retire();
    }
  }
}

TEST_F(FeatureMapTest, LearnsNothingOfAnAlmostHiddenPiece) {
  FeatureMap none{TrackerConfig().max_features};
  admit(keypoints(), &none, 0, false);
  EXPECT_TRUE(none.features().empty());
  const Found found = align();
  const std::vector<MapFeature> before = map_.features();
  map_.score(found.expected, found.all.matches, {false}, 1.0 / 30.0);
  for (std::size_t f = 0; f < before.size(); ++f) {
    EXPECT_EQ(map_.features()[f].expected_s, before[f].expected_s);
    EXPECT_EQ(map_.features()[f].found_s, before[f].found_s);
  }
}

TEST_F(FeatureMapTest, HoldsNoMoreThanAsked) {
  FeatureMap small(50);
  admit(keypoints(), &small);
  EXPECT_EQ(small.features().size(), 50u);
}

/// A new side in view gets as many features as the first one.
TEST_F(FeatureMapTest, HoldsTheSameNumberInEveryView) {
  FeatureMap small(40);
  std::size_t known = 0;
  for (int view = 0; view < 6; ++view) {
    const Eigen::Vector3d axis = view < 4 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
    show(
        transformed(box_.volume.rest_vertices, boxPose() * Eigen::AngleAxisd(0.5 * M_PI * view + 0.1, axis)));
    const ExpectedFeatures expected = expect(small);
    const int before = expected.count(), room = small.room(before);
    admit(chosen(small, expected), &small, before);
    EXPECT_LE(small.features().size(), known + room);
    if (view == 2) {
      EXPECT_GT(small.features().size(), 75u) << "the first views' features are out of view";
    }
    known = small.features().size();
    EXPECT_LE(expect(small).count(), std::max(40, before));
  }
}

TEST_F(FeatureMapTest, KeepsFourTimesAsManyAsMayBeInView) {
  FeatureMap small(40);
  for (const std::size_t kept : {40u, 80u, 120u, 160u, 160u}) {
    admit(keypoints(), &small);
    EXPECT_EQ(small.features().size(), kept) << "of what was admitted before, nothing is expected in view";
  }
  EXPECT_EQ(small.room(0), 0);
}

TEST_F(FeatureMapTest, ChoosesCornersOnTheBodyWhereFeaturesAreFew) {
  const cv::Rect& region = surface_.image().region;
  const std::vector<cv::KeyPoint> corners =
      orb_.detect(frame_.color, cv::Mat1b(frame_.color.size(), 255), region);
  FeatureMap half{TrackerConfig().max_features};
  const auto is_left = [&](const cv::KeyPoint& corner) { return corner.pt.x < region.x + region.width / 2; };
  std::vector<cv::KeyPoint> left;
  std::copy_if(corners.begin(), corners.end(), std::back_inserter(left), is_left);
  admit(orb_.describe(frame_.color, region, left), &half);
  const KnownPlaces known = placesOf(half, expect(half));
  const std::vector<cv::KeyPoint> chosen = chooseCorners(frame_, corners, surface_, {true}, known, 50, kGap);
  ASSERT_EQ(chosen.size(), 50u);
  EXPECT_LT(std::count_if(chosen.begin(), chosen.end(), is_left), 5);
  for (const cv::KeyPoint& corner : chosen)
    EXPECT_GT(surface_.image().depth(cv::Point(cvRound(corner.pt.x), cvRound(corner.pt.y))), 0.0f);
  EXPECT_TRUE(chooseCorners(frame_, corners, surface_, {false}, known, 50, kGap).empty());
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
