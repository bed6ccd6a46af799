#include <test_support/gtest.h>

#include <Eigen/Dense>

#include "fixtures/scene_fixtures.h"
#include "softbody_virtual_camera/camera/virtual_camera.h"

namespace softbody::virtual_camera {
namespace {

/// How far the vertex at the free end has sunk.
double sunk(const Scene& scene, double t) {
  const Points &rest = scene.actors.at(0).rest.vertices, now = inBodyFrame(scene, t);
  Eigen::Index tip = 0;
  rest.col(0).maxCoeff(&tip);
  return rest(tip, 2) - now(tip, 2);
}

TEST(Sag, TheFreeEndSinksByAFifthOfTheLengthAndHangsStill) {
  const Scene& scene = madeScene("sag");
  const double end = scene.duration_s;
  EXPECT_NEAR(sunk(scene, 1.0), 0.0, 1e-12);
  EXPECT_GT(sunk(scene, end), 0.15 * 0.2);
  EXPECT_LT(sunk(scene, end), 0.25 * 0.2);
  EXPECT_LT((inBodyFrame(scene, end) - inBodyFrame(scene, end - 1.5)).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(Sag, TheClampHoldsItsEndAndCarriesTheWeight) {
  const Scene& scene = madeScene("sag");
  const Points &rest = scene.actors.at(0).rest.vertices, now = inBodyFrame(scene, scene.duration_s);
  for (Eigen::Index i = 0; i < rest.rows(); ++i) {
    if (rest(i, 0) < -0.0601) {
      EXPECT_LT((now.row(i) - rest.row(i)).norm(), 1e-9);
    }
  }
  const SceneState start = scene.state(0.5), end = scene.state(scene.duration_s);
  ASSERT_EQ(end.wrenches.size(), 1u);
  EXPECT_EQ(end.wrenches[0].name, "clamp");
  ASSERT_EQ(end.frames.size(), 1u);
  EXPECT_EQ(end.frames[0].name, "clamp");
  ASSERT_TRUE(scene.material);
  const double weight = 9.81 * scene.material->mass();
  // The support carries what the clamp does not hold.
  EXPECT_LT(start.wrenches.at(0).force.norm(), 0.4 * weight);
  EXPECT_GT(start.wrenches.at(0).force.norm(), 0.1 * weight);
  // The frame's z axis is up.
  const Eigen::Matrix3d R_world_clamp =
      scene.T_camera_world.linear().transpose() * end.frames[0].T_camera_frame.linear();
  EXPECT_LT((R_world_clamp.col(2) - Eigen::Vector3d::UnitZ()).norm(), 1e-9);
  EXPECT_LT((end.wrenches[0].force + weight * Eigen::Vector3d::UnitZ()).norm(), 1e-4 * weight);
  EXPECT_NEAR(end.wrenches[0].torque.y(), weight * 0.06, 0.02 * weight);
  EXPECT_TRUE(scene.has_weight);
}

TEST(Sag, AStifferAndLargerBodyOfThatDensitySagsInTheSameWay) {
  const Scene& usual = madeScene("sag");
  Body large = shippedBody("sponge");
  large.rest.vertices *= 2.0;
  large.elasticity.youngs_modulus_pa *= 3.0;
  large.elasticity.density_kg_m3 = 1.5 * *usual.material->elasticity.density_kg_m3;
  const Scene scene = makeScene("sag", large, 1);
  EXPECT_LT((inBodyFrame(scene, 5.0) - 2.0 * inBodyFrame(usual, 5.0)).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_NEAR(scene.material->mass(), 12.0 * usual.material->mass(), 1e-9);
  const ContactWrench small = usual.state(5.0).wrenches.at(0), found = scene.state(5.0).wrenches.at(0);
  EXPECT_LT((found.force - 12.0 * small.force).norm(), 1e-4);
  EXPECT_LT((found.torque - 24.0 * small.torque).norm(), 1e-4);
  // Without a density the scene chooses the same one.
  large.elasticity.density_kg_m3.reset();
  EXPECT_NEAR(*makeScene("sag", large, 1).material->elasticity.density_kg_m3,
              1.5 * *usual.material->elasticity.density_kg_m3, 1e-3);
}

TEST(Sag, ABodyThatWouldLieOnTheTableIsRefused) {
  Body soft = shippedBody("sponge");
  soft.elasticity.youngs_modulus_pa = 6e3;
  soft.elasticity.density_kg_m3 = 120.0;
  EXPECT_TRUE(says(complaint([&] { makeScene("sag", soft, 1); }), "--density"));
}

TEST(Swing, SwingsUnderItsWeightUntilItHangsStill) {
  const Scene& scene = madeScene("swing");
  EXPECT_NEAR(sunk(scene, 1.0), 0.0, 1e-12);
  double lowest = 0.0, highest_later = 1.0;
  for (double t = 1.0; t < 1.5; t += 0.005) lowest = std::max(lowest, sunk(scene, t));
  for (double t = 1.15; t < 1.5; t += 0.005) highest_later = std::min(highest_later, sunk(scene, t));
  const double hangs = sunk(scene, 30.0);
  EXPECT_GT(lowest, 1.5 * hangs);
  EXPECT_LT(lowest, 2.1 * hangs);
  EXPECT_LT(highest_later, 0.6 * hangs);
  const ContactWrench end = scene.state(scene.duration_s).wrenches.at(0);
  EXPECT_NEAR(-end.force.z() / (9.81 * scene.material->mass()), 1.0, 0.05);
}

TEST(WrenchSensor, HasNoiseBiasAndDrift) {
  WrenchSensorOptions options;
  options.std_n = 0.1;
  options.bias_n = {1.0, 0.0, 0.0};
  options.drift_n_s = {0.0, 0.2, 0.0};
  const WrenchSensor sensor(options, 3);
  constexpr int kFrames = 4000;
  Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero(), squares = sum;
  for (int frame = 0; frame < kFrames; ++frame) {
    const auto found = sensor.measured(frame, 5.0, {{"a"}, {"b"}});
    EXPECT_NE(found[0].force, found[1].force);
    Eigen::Matrix<double, 6, 1> both;
    both << found[0].force, found[0].torque / 0.05;
    sum += both;
    squares += both.cwiseAbs2();
  }
  sum /= kFrames;
  const Eigen::Array<double, 6, 1> spread = (squares / kFrames - sum.cwiseAbs2()).array().sqrt();
  for (int half = 0; half < 2; ++half) {
    EXPECT_LT((sum.segment<3>(3 * half) - Eigen::Vector3d(1.0, 1.0, 0.0)).norm(), 0.01);
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(spread[3 * half + axis], 0.1, 0.005);
  }
  EXPECT_EQ(sensor.measured(7, 0.1, {{"a"}})[0].force, sensor.measured(7, 0.1, {{"a"}})[0].force);
  options.noise = false;
  EXPECT_NEAR(WrenchSensor(options, 3).measured(7, 5.0, {{"a"}})[0].force.y(), 1.0, 1e-12);
}

}  // namespace
}  // namespace softbody::virtual_camera
