#include <gtest/gtest.h>

#include <random>

#include "features/feature_recognition.h"
#include "fixtures/synthetic_scene.h"
#include "softbody_common/geometry/rigid_fit.h"

namespace softbody {
namespace {

constexpr double kTolerance = 0.006;

/// Right pairs of a body of 200 mm, and random pairs in the same volume.
struct Pairs {
  std::mt19937 random;
  std::uniform_real_distribution<double> uniform{-1.0, 1.0};

  explicit Pairs(unsigned seed) : random(seed) {}

  Eigen::Vector3d vector(double size) {
    return size * Eigen::Vector3d(uniform(random), uniform(random), uniform(random));
  }

  Eigen::Isometry3d motion() {
    return Eigen::Translation3d(vector(0.3)) *
           Eigen::AngleAxisd(M_PI * uniform(random), vector(1.0).normalized()) *
           Eigen::Isometry3d::Identity();
  }

  std::vector<PointPair> make(const Eigen::Isometry3d& motion, int right, int wrong) {
    std::vector<PointPair> pairs;
    for (int i = 0; i < right; ++i) {
      const Eigen::Vector3d expected = vector(0.1);
      pairs.push_back({expected, motion * expected + vector(0.3 * kTolerance)});
    }
    for (int i = 0; i < wrong; ++i) pairs.push_back({vector(0.1), motion * vector(0.1)});
    std::shuffle(pairs.begin(), pairs.end(), random);
    return pairs;
  }
};

TEST(FeatureRecognition, FindsTheMotionThatAQuarterOfThePairsAgreeWith) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Pairs pairs(seed);
    const Eigen::Isometry3d motion = pairs.motion();
    const auto found = recognizedMotion(pairs.make(motion, 50, 150), kTolerance);
    ASSERT_TRUE(found) << "seed " << seed;
    for (int i = 0; i < 10; ++i) {
      const Eigen::Vector3d point = pairs.vector(0.1);
      EXPECT_LT((*found * point - motion * point).norm(), 0.5 * kTolerance) << "seed " << seed;
    }
  }
}

TEST(FeatureRecognition, TakesNoChanceForAMotion) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Pairs pairs(seed);
    EXPECT_FALSE(recognizedMotion(pairs.make(pairs.motion(), 0, 300), kTolerance)) << "seed " << seed;
    EXPECT_FALSE(recognizedMotion(pairs.make(pairs.motion(), 10, 0), kTolerance)) << "seed " << seed;
  }
  EXPECT_FALSE(recognizedMotion({}, kTolerance));
}

/// Among more pairs, more agree by chance; most of all on a flat face.
TEST(FeatureRecognition, TakesNoChanceOfManyPairsOnAFaceForAMotion) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    Pairs pairs(seed);
    std::vector<PointPair> all = pairs.make(pairs.motion(), 0, 1500);
    for (PointPair& pair : all) pair.expected.z() = pair.measured.z() = 0.0;
    EXPECT_FALSE(recognizedMotion(all, kTolerance)) << "seed " << seed;
  }
}

TEST(FeatureRecognition, TakesNoPairsOfOnePlaceForAMotion) {
  const std::vector<PointPair> same(40, {Eigen::Vector3d(0.01, 0.02, 0.03), Eigen::Vector3d(0.1, 0.0, 0.5)});
  EXPECT_FALSE(recognizedMotion(same, kTolerance));
}

/// A descriptor with this Hamming distance from the zero descriptor.
Descriptor descriptorOf(int bits) { return {(1ull << bits) - 1, 0, 0, 0}; }

TEST(FeatureRecognition, PairsAKeypointWithTheFeatureMostLikeIt) {
  const BoxBody box = makeBox();
  const Points vertices = transformed(box.volume.rest_vertices, boxPose());
  const RgbdFrame frame = renderFrame(box, vertices, 1);
  Keypoint keypoint;
  keypoint.pixel = {320.0f, 240.0f};
  std::vector<MapFeature> features(3);
  for (int f = 0; f < 3; ++f) {
    features[f].place = {40 * f, Eigen::Vector4d::Constant(0.25)};
    features[f].descriptor = descriptorOf(f == 1 ? 2 : 5);
  }
  const auto pairs =
      recognizedFeatures(frame, features, {keypoint}, SurfaceModel(box.volume, box.surface), vertices);
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_EQ(pairs[0].expected, positionOf(features[1].place, vertices, box.volume.tets));
}

}  // namespace
}  // namespace softbody
