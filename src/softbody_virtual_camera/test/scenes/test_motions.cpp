#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <opencv2/core.hpp>

#include "fixtures/scene_fixtures.h"
#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_virtual_camera/camera/virtual_camera.h"

namespace softbody::virtual_camera {
namespace {

const Pinhole kMotionCamera = d435(640, 480);
constexpr double kThirtyDegrees = 3.14159265358979 / 6.0;

Scene motionScene(const std::string& name, const std::string& body = "sponge") {
  return makeScene(name, shippedBody(body), 1);
}

/// The point of the sponge's middle plane over x at rest, in the body's frame.
Eigen::Vector3d middleAt(const Scene& scene, const SceneState& state, double x) {
  const Points& rest = scene.actors[0].rest.vertices;
  const Points moved = transformed(state.T_camera_body.inverse(), state.vertices[0]);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int count = 0;
  for (Eigen::Index i = 0; i < rest.rows(); ++i) {
    if (std::abs(rest(i, 0) - x) > 1e-6 || std::abs(std::abs(rest(i, 2)) - 0.02) > 1e-6) continue;
    sum += moved.row(i).transpose();
    ++count;
  }
  return sum / count;
}

/// Of the circle through the ends and the middle; positive if the ends are above.
double curvatureOf(const Scene& scene, double t) {
  const SceneState state = scene.state(t);
  const Eigen::Vector3d a = middleAt(scene, state, -0.1), b = middleAt(scene, state, 0.0),
                        c = middleAt(scene, state, 0.1);
  const Eigen::Vector3d normal = (b - a).cross(c - b);
  const double size = 2.0 * normal.norm() / ((b - a).norm() * (c - b).norm() * (c - a).norm());
  return normal.y() < 0.0 ? size : -size;
}

TEST(Motions, RigidMovesByFiveCentimetresAndThirtyDegreesAndComesBack) {
  for (const char* body : {"sponge", "doll"}) {
    const Scene scene = motionScene("rigid", body);
    const Eigen::Isometry3d start = scene.state(0.0).T_camera_body;
    for (const double t : {0.5, 2.0, 3.0, 4.5}) {
      const SceneState state = scene.state(t);
      const Eigen::Isometry3d step = state.T_camera_body * start.inverse();
      const double share = t == 2.0 || t == 3.0 ? 1.0 : 0.0;
      EXPECT_NEAR((state.T_camera_body.translation() - start.translation()).norm(), 0.05 * share, 1e-9);
      EXPECT_NEAR(Eigen::AngleAxisd(step.linear()).angle(), kThirtyDegrees * share, 1e-6);
      EXPECT_TRUE(
          state.vertices[0].isApprox(transformed(state.T_camera_body, scene.actors[0].rest.vertices)));
    }
  }
}

TEST(Motions, FastBendsTwiceASecondAndSwingsAtItsSpeed) {
  const Scene scene = motionScene("fast");
  constexpr double kStep = 5e-3;
  double speed = 0.0, last = 0.0;
  int bends = 0;
  for (double t = 0.0; t < scene.duration_s; t += kStep) {
    speed = std::max(speed, (scene.state(t + kStep).T_camera_body.translation() -
                             scene.state(t).T_camera_body.translation())
                                    .norm() /
                                kStep);
    const double curvature = curvatureOf(scene, t);
    EXPECT_LT(std::abs(curvature), 7.01);
    bends += std::abs(last) < 5.0 && std::abs(curvature) >= 5.0 && t > 1.0 && t < 4.0;
    last = curvature;
  }
  EXPECT_EQ(bends, 6);
  EXPECT_NEAR(speed, 0.7, 0.02);
}

TEST(Motions, RollReachesItsCurvature) {
  const Scene scene = motionScene("roll");
  EXPECT_NEAR(curvatureOf(scene, 0.25), 0.0, 1e-6);
  EXPECT_NEAR(curvatureOf(scene, 2.5), 14.0, 1e-6);
}

TEST(Motions, RollBendsATallBodySidewaysAndRefusesACube) {
  const Scene doll = motionScene("roll", "doll");
  const SceneState state = doll.state(2.5);
  const Points moved = transformed(state.T_camera_body.inverse(), state.vertices[0]);
  const Points& rest = doll.actors[0].rest.vertices;
  EXPECT_LT((moved - rest).col(2).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_GT((moved - rest).col(1).maxCoeff(), 0.03);
  Body cube = shippedBody("sponge");
  cube.rest.vertices.col(1) *= 2.0;
  cube.rest.vertices.col(2) *= 5.0;
  EXPECT_THROW(makeScene("roll", cube, 1), std::invalid_argument);
}

TEST(Motions, FarIsTheBendingBodyNineTenthsOfAMetreAway) {
  const Scene near = motionScene("bend"), far = motionScene("far");
  EXPECT_NEAR(far.state(0.0).T_camera_body.translation().norm(), 0.9, 1e-9);
  for (const double t : {0.0, 1.5, 3.5, 4.9}) {
    const SceneState there = far.state(t), here = near.state(t);
    EXPECT_TRUE(transformed(there.T_camera_body.inverse(), there.vertices[0])
                    .isApprox(transformed(here.T_camera_body.inverse(), here.vertices[0])));
  }
  EXPECT_EQ(far.duration_s, 8.0);
  for (double time = 5.0; time < 8.5; time += 0.1)
    EXPECT_TRUE(far.state(time).vertices[0].isApprox(far.state(0.0).vertices[0])) << time;
}

/// Standard deviation of the green channel's noise on the middle of the image.
double noiseOf(const Scene& scene) {
  NoiseOptions noise = noNoise();
  const cv::Mat3b clean = VirtualCamera(scene, kMotionCamera, noise, 1).capture(3, 0.0).color;
  noise.color.enabled = true;
  const cv::Mat3b noisy = VirtualCamera(scene, kMotionCamera, noise, 1).capture(3, 0.0).color;
  cv::Mat difference;
  cv::subtract(noisy, clean, difference, cv::noArray(), CV_32FC3);
  cv::Scalar mean, deviation;
  cv::meanStdDev(difference, mean, deviation);
  return deviation[1];
}

TEST(Motions, DimIsDarkFlickersAndHasMoreNoise) {
  const Scene dim = motionScene("dim"), bright = motionScene("bend");
  double least = 1e9, most = 0.0;
  for (double t = 0.0; t < 5.0; t += 1e-3) {
    const double brightness = dim.state(t).brightness;
    least = std::min(least, brightness);
    most = std::max(most, brightness);
    EXPECT_EQ(bright.state(t).brightness, 1.0);
  }
  const double mean = 0.5 * (least + most);
  EXPECT_NEAR(most / mean, 1.25, 1e-3);
  EXPECT_LT(mean, 0.5);
  const auto green = [](const Scene& scene, double t) {
    return cv::mean(VirtualCamera(scene, kMotionCamera, noNoise(), 1).capture(0, t).color)[1];
  };
  for (const double t : {0.0, 0.1}) {
    EXPECT_NEAR(green(dim, t), dim.state(t).brightness * green(bright, t), 0.5);
  }
  EXPECT_GT(noiseOf(dim), 1.5 * noiseOf(bright));
}

TEST(Motions, SqueezeShortensTheBodyLikePushAndKeepsItsMiddle) {
  for (const char* body : {"sponge", "doll"}) {
    const Scene scene = motionScene("squeeze", body);
    const TriangleMesh& rest = scene.actors[0].rest;
    const SceneState state = scene.state(2.5);
    const Points moved = transformed(state.T_camera_body.inverse(), state.vertices[0]);
    const Eigen::RowVector3d size = moved.colwise().maxCoeff() - moved.colwise().minCoeff();
    const Eigen::RowVector3d rest_size =
        rest.vertices.colwise().maxCoeff() - rest.vertices.colwise().minCoeff();
    EXPECT_NEAR(size.x() / rest_size.x(), 0.7, 1e-9);
    EXPECT_NEAR(size.y() / rest_size.y(), std::pow(0.7, -0.2), 1e-9);
    EXPECT_NEAR(
        enclosedVolume(state.vertices[0], rest.triangles) / enclosedVolume(rest.vertices, rest.triangles),
        std::pow(0.7, 1.0 - 2.0 * 0.2), 1e-9);
    EXPECT_NEAR(moved.col(0).maxCoeff() + moved.col(0).minCoeff(), 0.0, 1e-6);
  }
}

TEST(Motions, OnTheTableTheBodyLiesInItsShadow) {
  for (const char* body : {"sponge", "doll"}) {
    const Scene scene = motionScene("table", body), above = motionScene("still", body);
    for (const double t : {0.0, 1.5, 2.5, 5.0}) {
      const Points placed = transformed(scene.T_camera_world.inverse(), scene.state(t).vertices[0]);
      EXPECT_NEAR(placed.col(2).minCoeff(), 0.0, 1e-9) << body << " at " << t;
      EXPECT_LT(placed.leftCols(2).colwise().mean().norm(), 0.02) << body << " at " << t;
    }
    const auto brightness = [&](double x, double y) {
      const Eigen::Vector3d place(x, y, 0.0);
      return scene.actors[1].texture(place).y() / above.actors[1].texture(place).y();
    };
    EXPECT_NEAR(brightness(0.0, 0.0), 0.4, 1e-3);
    EXPECT_NEAR(brightness(0.3, -0.2), 1.0, 1e-3);
    float last = 0.0f;
    for (double x = 0.0; x < 0.3; x += 1e-3) {
      const float now = brightness(x, 0.0);
      EXPECT_GE(now, last - 1e-5f);
      EXPECT_LT(now - std::max(last, 0.4f), 0.05f);  // soft
      last = now;
    }
  }
}

}  // namespace
}  // namespace softbody::virtual_camera
