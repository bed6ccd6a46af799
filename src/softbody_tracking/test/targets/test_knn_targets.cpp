#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "fixtures/synthetic_scene.h"
#include "softbody_common/geometry/rigid_fit.h"
#include "targets/knn_targets.h"

namespace softbody {
namespace {

const Eigen::Matrix3d kUpright =
    Eigen::Matrix3d::Identity();  // the camera as it was when features were bound

TEST(InverseDistanceWeights, SumToOneAndFallWithDistance) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> uniform(1e-4, 0.01);
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<double> distances(1 + trial % 10);
    for (double& d : distances) d = uniform(random);
    std::sort(distances.begin(), distances.end());
    const std::vector<double> weights = inverseDistanceWeights(distances);
    EXPECT_NEAR(std::accumulate(weights.begin(), weights.end(), 0.0), 1.0, 1e-12);
    EXPECT_TRUE(std::is_sorted(weights.rbegin(), weights.rend()));
  }
}

TEST(InverseDistanceWeights, GuardsWhereThePapersFormulaDividesZeroByZero) {
  EXPECT_EQ(inverseDistanceWeights({}), std::vector<double>());
  EXPECT_EQ(inverseDistanceWeights({0.004}), std::vector<double>({1.0}));
  EXPECT_EQ(inverseDistanceWeights({0.0, 0.004}), std::vector<double>({1.0, 0.0}));
  EXPECT_EQ(inverseDistanceWeights({0.004, 0.004}), std::vector<double>({0.5, 0.5}));
}

/// Features strewn over the box's top face, all found again after a rigid motion.
struct MovedFeatures {
  BoxBody box = makeBox();
  RasterMemory memory;
  PredictedSurface surface{std::make_shared<SurfaceModel>(box.volume, box.surface),
                           {640, 480, 615.0, 615.0, 320.0, 240.0},
                           box.volume.rest_vertices,
                           &memory};
  std::vector<MapFeature> features;
  std::vector<FeatureMatch> matches;

  explicit MovedFeatures(const Eigen::Isometry3d& motion) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> x(-0.1, 0.1), y(-0.05, 0.05);
    for (int i = 0; i < 1000; ++i) {
      MapFeature feature;
      feature.id = i;
      feature.reference = {x(random), y(random), 0.02};
      features.push_back(feature);
      FeatureMatch match;
      match.feature = i;
      match.association.measured = motion * feature.reference;
      matches.push_back(match);
    }
  }
};

double worstError(const MovedFeatures& moved, bool local_rotation, const Eigen::Isometry3d& motion,
                  const Eigen::Matrix3d& R_camera_fixed = kUpright) {
  KnnConfig config;
  config.local_rotation = local_rotation;
  KnnTargets knn(config);
  knn.bind(moved.features, moved.box.volume, moved.box.volume.rest_vertices);
  const auto associations = knn.associations(moved.features, moved.matches, moved.surface, R_camera_fixed);
  EXPECT_GT(associations.size(), 60u) << "the top face has 66 vertices";
  double worst = 0.0;
  for (const Association& a : associations)
    worst = std::max(worst, (a.measured - motion * a.predicted).norm());
  return worst;
}

TEST(KnnTargets, TranslationsAreExact) {
  const Eigen::Isometry3d motion(Eigen::Translation3d(0.03, -0.01, 0.02));
  EXPECT_LT(worstError(MovedFeatures(motion), false, motion), 1e-9);
  EXPECT_LT(worstError(MovedFeatures(motion), true, motion), 1e-9);
}

TEST(KnnTargets, ACameraThatTurnsIsNoRotationOfTheBody) {
  const Eigen::Isometry3d motion(Eigen::AngleAxisd(0.26, Eigen::Vector3d(1.0, 1.0, 1.0).normalized()));
  EXPECT_LT(worstError(MovedFeatures(motion), false, motion, motion.linear()), 1e-9);
}

TEST(KnnTargets, LocalRotationMendsThePapersErrorUnderRotation) {
  const Eigen::Isometry3d motion(Eigen::AngleAxisd(0.26, Eigen::Vector3d(1.0, 1.0, 1.0).normalized()));
  const MovedFeatures moved(motion);
  EXPECT_GT(worstError(moved, false, motion), 5e-4);
  EXPECT_LT(worstError(moved, true, motion), 1e-9);
}

TEST(KnnTargets, VerticesWithoutFeaturesGetNoTarget) {
  MovedFeatures moved(Eigen::Isometry3d::Identity());
  KnnTargets knn{KnnConfig()};
  knn.bind(moved.features, moved.box.volume, moved.box.volume.rest_vertices);
  for (const Association& a : knn.associations(moved.features, moved.matches, moved.surface, kUpright)) {
    EXPECT_GT(a.predicted.z(), 0.0) << "the bottom face has no feature within 10 mm";
  }
  moved.matches.clear();
  EXPECT_TRUE(knn.associations(moved.features, moved.matches, moved.surface, kUpright).empty());
  knn.bind({}, moved.box.volume, moved.box.volume.rest_vertices);
  EXPECT_TRUE(knn.associations({}, {}, moved.surface, kUpright).empty());
}

}  // namespace
}  // namespace softbody
