#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "paper/followed_vertices.h"

namespace softbody::evaluation {
namespace {

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

/// Two features near vertex 0 of one tet, one beyond the radius of 10 mm.
struct FollowedTet {
  TetTopology volume;
  std::vector<TrackedFeature> features;

  FollowedTet() {
    volume.rest_vertices.resize(4, 3);
    volume.rest_vertices << 0, 0, 0, 0.1, 0, 0, 0, 0.1, 0, 0, 0, 0.1;
    volume.surface.resize(4, 3);
    volume.surface << 0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3;
    for (const double x : {0.002, 0.004, 0.011}) {
      TrackedFeature feature;
      feature.id = static_cast<int>(features.size());
      feature.pixel.setZero();
      feature.position = feature.reference = {x, 0.0, 0.0};
      features.push_back(feature);
    }
  }
};

TEST(FollowedVertices, MoveWithTheFeaturesThatAreFound) {
  FollowedTet tet;
  const FollowedVertices vertices(tet.features, tet.volume, tet.volume.rest_vertices);
  const Eigen::Vector3d near(0.0, 0.003, 0.0), far(0.0, 0.0, 0.005);
  tet.features[0].position += near;
  tet.features[1].position += far;
  const auto motion = [&](const std::vector<TrackedFeature>& found) {
    const std::vector<MovedVertex> moved = vertices.moved(found);
    return moved.size() == 1 && moved[0].vertex == 0 ? moved[0].position : Eigen::Vector3d(1.0, 1.0, 1.0);
  };
  EXPECT_TRUE(motion(tet.features).isApprox(near)) << "the farthest neighbour has weight 0 in eq. 3";
  EXPECT_TRUE(vertices.moved({tet.features[1], tet.features[2]}).empty());
  EXPECT_TRUE(vertices.moved({}).empty());
}

}  // namespace
}  // namespace softbody::evaluation
