#include "softbody_evaluation/models/model_fit.h"

#include <test_support/gtest.h>

#include <random>

#include "fixtures/round_bodies.h"
#include "softbody_common/geometry/rigid_fit.h"

namespace softbody::evaluation {
namespace {

Eigen::Isometry3d randomPose(unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const auto draw = [&] { return normal(random); };
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::Quaterniond(draw(), draw(), draw(), draw()).normalized().matrix();
  pose.translation() = 0.3 * Eigen::Vector3d(draw(), draw(), draw());
  return pose;
}

Model moved(Model model, const Eigen::Isometry3d& pose) {
  model.mesh.vertices = transformed(model.mesh.vertices, pose);
  return model;
}

/// Largest distance of a vertex from its true place after the fit [m].
double misplaced(const Model& scanned, const Model& truth, const Eigen::Isometry3d& pose) {
  const Points places =
      transformed(moved(scanned, pose).mesh.vertices, fitModel(moved(scanned, pose), truth));
  return (places - scanned.mesh.vertices).rowwise().norm().maxCoeff();
}

TEST(ModelFit, FindsEveryPose) {
  for (unsigned seed = 0; seed < 4; ++seed)
    EXPECT_LT(misplaced(potato(), potato(), randomPose(seed)), 1e-5) << seed;
}

TEST(ModelFit, HalfOfTheSurfaceIsEnoughAndTheRestDoesNotPull) {
  for (unsigned seed = 2; seed < 5; ++seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    const Eigen::Vector3d side(normal(random), normal(random), normal(random));
    const Model half = part(potato(), [&](const Eigen::Vector3d& p) { return side.dot(p) > 0.0; });
    EXPECT_LT(misplaced(half, potato(), randomPose(seed)), 2e-5) << seed;
  }
}

TEST(ModelFit, PlacesThatWereNeverSeenDoNotPull) {
  Model flat = potato();  // the scan closes what it did not see with a plane
  for (auto row : flat.mesh.vertices.rowwise()) {
    flat.seen.push_back(row.z() > -0.01 ? 1.0f : 0.0f);
    row.z() = std::max(row.z(), -0.011);
  }
  EXPECT_LT(misplaced(flat, potato(), randomPose(3)), 1e-4);
}

TEST(ModelFit, RefusesBodiesOfOtherSize) {
  Model large = potato();
  large.mesh.vertices *= 1000.0;
  large.name = "large.obj";
  const std::string said = complaint([&] { fitModel(large, potato()); });
  EXPECT_TRUE(says(said, "large.obj"));
  EXPECT_TRUE(says(said, "metres"));
}

}  // namespace
}  // namespace softbody::evaluation
