#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "cutting/blade/tear_plane.h"
#include "cutting/blade/tearing.h"
#include "fixtures/box_meshes.h"
#include "fixtures/test_meshes.h"
#include "softbody_common/geometry/rigid_fit.h"
#include "softbody_common/geometry/tet_geometry.h"

namespace softbody {
namespace {

constexpr double kLimit = 0.4, kStrain = 0.2, kNoise = 3e-4;  // -, -, [m]

/// A sponge that is stretched by kStrain and has torn across that. The strain bends a little, so the tets'
/// own direction is a degree off.
struct TornSponge {
  TornSponge(double gap_m_in, std::mt19937* random) : gap_m(gap_m_in) {
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    plane.normal = Eigen::Vector3d(1.0, 0.15 * uniform(*random), 0.0).normalized();
    plane.point = Eigen::Vector3d(0.1 + 0.03 * uniform(*random), 0.05, 0.015);
    state.vertices = volume.rest_vertices;
    for (auto&& row : state.vertices.rowwise()) row = moved(row);
    state.standard_deviation.assign(static_cast<std::size_t>(state.vertices.rows()), 3e-4f);
    state.confidence.assign(state.standard_deviation.size(), 1.0f);
    std::normal_distribution<double> noise(0.0, kNoise);
    std::uniform_int_distribution<int> tet(0, static_cast<int>(volume.tets.rows()) - 1);
    while (targets.size() < 1000) {
      Target target{TargetKind::kFeature, {tet(*random), weights(random)}};
      const Eigen::RowVector3d rest = positionOf(target.place, volume.rest_vertices, volume.tets);
      target.position = moved(rest).transpose();
      for (double& coordinate : target.position) coordinate += noise(*random);
      target.position = pose * target.position;
      targets.push_back(target);
    }
    state.vertices = transformed(state.vertices, pose);
  }
  Eigen::RowVector3d moved(const Eigen::RowVector3d& rest) const {
    const bool beyond = plane.normal.dot(rest.transpose() - plane.point) > 0.0;
    const Eigen::Vector3d off = plane.normal + 0.03 * plane.normal.unitOrthogonal();
    return rest + kStrain * plane.normal.dot(rest.transpose() - plane.point) * off.transpose() +
           (beyond ? gap_m : 0.0) * plane.normal.transpose();
  }
  static Eigen::Vector4d weights(std::mt19937* random) {
    std::exponential_distribution<double> share;
    Eigen::Vector4d result(share(*random), share(*random), share(*random), share(*random));
    return result / result.sum();
  }
  std::optional<CutPatch> tear() const { return TearWatch(kLimit).follow(volume, state, targets); }
  double farthestFrom(const CutPatch& patch) const {
    return ((patch.vertices.rowwise() - plane.point.transpose()) * plane.normal).cwiseAbs().maxCoeff();
  }

  const TetTopology volume = testing::sponge();
  const Eigen::Isometry3d pose = testing::somePose();
  double gap_m;
  RestPlane plane;
  MeshState state;
  std::vector<Target> targets;
};

TEST(TearPlane, TheTrackedFeaturesSayWhere) {
  std::mt19937 random(1);
  for (int k = 0; k < 20; ++k) {
    const TornSponge sponge(0.012, &random);
    const auto patch = sponge.tear();
    ASSERT_TRUE(patch) << k;
    EXPECT_LT(sponge.farthestFrom(*patch), 5e-3) << k;
  }
}

TEST(TearPlane, WrongMatchesDoNotMoveIt) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-0.05, 0.05);
  for (int k = 0; k < 10; ++k) {
    TornSponge sponge(0.012, &random);
    for (std::size_t i = 0; i < sponge.targets.size(); i += 50)
      for (double& coordinate : sponge.targets[i].position) coordinate += uniform(random);
    const auto patch = sponge.tear();
    ASSERT_TRUE(patch) << k;
    EXPECT_LT(sponge.farthestFrom(*patch), 5e-3) << k;
  }
}

/// In some of the bodies the tets' stretch is too uncertain to tell, but the features of both sides have
/// parted.
TEST(TearPlane, PartedFeaturesTearBeforeTheStretchIsSure) {
  std::mt19937 random(6);
  int with = 0, without = 0;
  for (int k = 0; k < 20; ++k) {
    TornSponge torn(0.012, &random), whole(0.0, &random);
    for (TornSponge* sponge : {&torn, &whole})
      sponge->state.standard_deviation.assign(sponge->state.confidence.size(), 2.8e-3f);
    EXPECT_FALSE(whole.tear()) << k;
    with += torn.tear() ? 1 : 0;
    for (Target& target : torn.targets) target.kind = TargetKind::kDepth;
    without += torn.tear() ? 1 : 0;
  }
  EXPECT_GE(with, 18);
  EXPECT_LE(without, 10);
}

/// The plane of the strain alone lies anywhere in the stretched tets.
TEST(TearPlane, WithoutFeaturesItIsTheMiddleOfTheStretch) {
  std::mt19937 random(3);
  for (int k = 0; k < 10; ++k) {
    TornSponge sponge(0.012, &random);
    for (Target& target : sponge.targets) target.kind = TargetKind::kDepth;
    const auto patch = sponge.tear();
    ASSERT_TRUE(patch) << k;
    EXPECT_LT(sponge.farthestFrom(*patch), 0.025) << k;
  }
}

TEST(TearPlane, NeitherStrainBelowTheLimitNorWrongMatchesTear) {
  std::mt19937 random(4);
  for (int k = 0; k < 10; ++k) {
    TornSponge sponge(0.0, &random);
    EXPECT_FALSE(sponge.tear()) << k;
    sponge.targets[17].position += Eigen::Vector3d(0.05, 0.0, 0.0);
    EXPECT_FALSE(sponge.tear()) << k;
  }
}

TEST(TearPlane, ItDoesNotDependOnTheOrderOfTheTargets) {
  std::mt19937 random(5);
  TornSponge sponge(0.012, &random);
  const auto patch = sponge.tear();
  std::shuffle(sponge.targets.begin(), sponge.targets.end(), random);
  const auto shuffled = sponge.tear();
  ASSERT_TRUE(patch && shuffled);
  ASSERT_EQ(patch->vertices.rows(), shuffled->vertices.rows());
  EXPECT_LT((patch->vertices - shuffled->vertices).cwiseAbs().maxCoeff(), 1e-9);
}

}  // namespace
}  // namespace softbody
