#include <test_support/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "camera/camera_motion.h"
#include "fixtures/scene_fixtures.h"
#include "softbody_virtual_camera/camera/camera_setup.h"

namespace softbody::virtual_camera {
namespace {

constexpr double kDegree = M_PI / 180.0;

Scene spongeScene(const std::string& name) { return makeScene(name, shippedBody("sponge"), 1); }

/// Angle between the camera's first optical axis and that at t [rad].
double turnOf(const Scene& scene, double t) {
  const auto axis = [&](double time) -> Eigen::Vector3d {
    return scene.state(time).T_world_camera->linear().col(2);
  };
  return std::acos(std::clamp(axis(0.0).dot(axis(t)), -1.0, 1.0));
}

TEST(CameraMotion, NoneIsTheSceneItself) {
  const Scene scene = spongeScene("bend"), same = withCameraMotion("none", scene);
  EXPECT_EQ(same.state(1.3).vertices, scene.state(1.3).vertices);
  EXPECT_FALSE(same.state(1.3).T_world_camera);
}

TEST(CameraMotion, NamesTheKnownOnes) {
  EXPECT_TRUE(says(complaint([&] { withCameraMotion("zigzag", spongeScene("still")); }), "none, orbit"));
}

TEST(CameraMotion, EverythingStaysWhereItIsInTheWorld) {
  for (const char* name : {"bend", "shake"}) {
    const Scene scene = spongeScene(name), moved = withCameraMotion("orbit", scene);
    const Eigen::Isometry3d T_world_start = scene.T_camera_world.inverse();
    for (const double t : {0.0, 0.9, 2.5, 4.1, 11.7}) {
      const SceneState expected = scene.state(t), state = moved.state(t);
      const Eigen::Isometry3d& T_world_camera = state.T_world_camera.value();
      ASSERT_EQ(state.vertices.size(), expected.vertices.size());
      for (std::size_t i = 0; i < state.vertices.size(); ++i) {
        const Points there = transformed(T_world_camera, state.vertices[i]),
                     here = transformed(T_world_start, expected.vertices[i]);
        EXPECT_LT((there - here).cwiseAbs().maxCoeff(), 1e-12);
      }
      EXPECT_TRUE((T_world_camera * state.T_camera_body).isApprox(T_world_start * expected.T_camera_body));
      EXPECT_TRUE((T_world_camera.linear() * state.lights.to_main)
                      .isApprox(T_world_start.linear() * expected.lights.to_main));
    }
  }
}

TEST(CameraMotion, OrbitGoesAroundTheBodyAsAnArmDoes) {
  const Scene scene = withCameraMotion("orbit", spongeScene("still"));
  EXPECT_TRUE(scene.state(0.0).T_world_camera->isApprox(scene.T_camera_world.inverse()));
  constexpr double kStep = 1.0 / 30.0;
  double farthest = 0.0, widest = 0.0, fastest = 0.0, sharpest = 0.0;
  Eigen::Vector3d place = scene.state(0.0).T_world_camera->translation(), velocity = Eigen::Vector3d::Zero();
  for (double t = kStep; t < 30.0; t += kStep) {
    const SceneState state = scene.state(t);
    const Eigen::Vector3d step = state.T_world_camera->translation() - place;
    fastest = std::max(fastest, step.norm() / kStep);
    sharpest = std::max(sharpest, (step / kStep - velocity).norm() / kStep);
    place = state.T_world_camera->translation();
    velocity = step / kStep;
    farthest = std::max(farthest, state.T_camera_body.translation().norm());
    widest = std::max(widest, turnOf(scene, t));
  }
  EXPECT_NEAR(farthest, 0.55, 0.01);
  EXPECT_GT(widest, 20.0 * kDegree);
  EXPECT_LT(widest, 35.0 * kDegree);
  EXPECT_GT(fastest, 0.2);
  EXPECT_LT(fastest, 0.5);
  EXPECT_LT(sharpest, 1.5) << "m/s^2";
}

TEST(CameraMotion, TheTruthIsInTheWorld) {
  CameraSetup setup;
  setup.scene = "still";
  setup.camera_motion = "orbit";
  setup.config_folder = CONFIG_DIR;
  setup.width = 160;
  setup.height = 120;
  VirtualCamera camera = makeCamera(setup);
  const Capture start = camera.capture(0, 0.0), later = camera.capture(60, 2.0);
  EXPECT_LT((start.truth.vertices - later.truth.vertices).cwiseAbs().maxCoeff(), 1e-12);
  // The image moves all the same, and shows the body where its pose says.
  EXPECT_GT(cv::norm(start.color, later.color, cv::NORM_INF), 30.0);
  const Eigen::Vector3d seen =
      later.T_world_camera->inverse() * Eigen::Vector3d(later.truth.vertices.colwise().mean().transpose());
  const Eigen::Vector2d pixel = camera.pinhole().project(seen);
  const double depth = 1e-3 * later.depth_mm(static_cast<int>(pixel.y()), static_cast<int>(pixel.x()));
  EXPECT_NEAR(depth, seen.z(), 0.05);
}

}  // namespace
}  // namespace softbody::virtual_camera
