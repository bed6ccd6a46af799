#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <map>
#include <opencv2/imgproc.hpp>

#include "fixtures/scene_fixtures.h"
#include "softbody_tracking/tool/tool_tracker.h"
#include "softbody_virtual_camera/camera/camera_setup.h"

namespace softbody::virtual_camera {
namespace {

constexpr double kDegree = M_PI / 180.0;
const Pinhole kCamera = d435(640, 480);

ToolDescription shippedSheet() { return loadToolDescription(CONFIG_DIR "/sheet.yaml"); }

/// The camera's pose is known, and so all poses in the world are.
const Scene& scan(const std::string& name, const std::string& object = "sponge", bool jerks = false) {
  static std::map<std::string, Scene> made;
  const std::string key = name + object + (jerks ? "j" : "");
  const auto found = made.find(key);
  if (found != made.end()) return found->second;
  return made[key] = scanScene(name, shippedBody(object), 1, paintOf("rich"), {shippedSheet(), jerks, true});
}

std::size_t sheetOf(const Scene& scene) { return scene.actors.size() - 1 - scene.hands; }

/// Pose of an actor that does not deform: its first three vertices that are not on a line.
Eigen::Isometry3d poseOf(const Points& rest, const Points& now) {
  const Eigen::Matrix4d T = Eigen::umeyama(rest.transpose(), now.transpose(), false);
  return Eigen::Isometry3d(T);
}

Eigen::Isometry3d cameraPose(const Scene& scene, double t) { return *scene.state(t).T_world_camera; }

/// Turn of the camera's optical axis [rad].
double angleBetween(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return Eigen::AngleAxisd(a.linear().transpose() * b.linear()).angle();
}

TEST(Scans, TheBodyTouchesTheSheetAndStaysThere) {
  for (const std::string& name : scanNames()) {
    for (const char* object : {"sponge", "doll"}) {
      const Scene& scene = scan(name, object);
      for (const double t : {0.0, 7.3, 20.0}) {
        const SceneState state = scene.state(t);
        const std::size_t sheet = sheetOf(scene);
        const Eigen::Isometry3d T_camera_sheet =
            poseOf(scene.actors[sheet].rest.vertices, state.vertices[sheet]);
        const Points body = transformed(T_camera_sheet.inverse(), state.vertices[0]);
        EXPECT_NEAR(body.col(2).minCoeff(), 0.0, 1e-9) << name;
        EXPECT_LT(middleOf(body).head<2>().norm(), 0.02) << name;
        EXPECT_TRUE(
            state.vertices[0].isApprox(transformed(state.T_camera_body, scene.actors[0].rest.vertices)));
      }
    }
  }
}

TEST(Scans, FlipShowsWhatWasBelow) {
  const auto upwards = [](const std::string& name) -> Eigen::Vector3d {
    const SceneState state = scan(name).state(0.0);
    return (*state.T_world_camera * state.T_camera_body).linear().row(2);
  };
  EXPECT_LT(upwards("walk").dot(upwards("flip")), -0.99);
}

TEST(Scans, TheCameraSeesTheBodysMiddleFromAboveTheTable) {
  for (const std::string& name : scanNames()) {
    const Scene& scene = scan(name, "sponge", name != "turntable");
    for (double t = 0.0; t < scene.duration_s; t += 0.1) {
      const SceneState state = scene.state(t);
      const Eigen::Vector3d eye = state.T_world_camera->translation(), middle = middleOf(state.vertices[0]);
      EXPECT_GT(eye.z(), 0.1);
      const Eigen::Vector2d pixel = kCamera.project(middle);
      EXPECT_TRUE(kCamera.contains(pixel.x(), pixel.y())) << name << " at " << t;
      // No wall and no thing on the table is nearer to the camera than the body.
      const double distance = middle.norm();
      for (std::size_t i = 2; i < 4; ++i)
        EXPECT_GT(state.vertices[i].rowwise().norm().minCoeff(), 0.3 * distance) << name << " at " << t;
      for (const Points& vertices : {state.vertices[2]}) {
        const Points there = transformed(*state.T_world_camera, vertices);
        EXPECT_LT(eye.head<2>().cwiseAbs().maxCoeff(), there.col(0).maxCoeff());
      }
    }
  }
}

TEST(Scans, TheRoundCloses) {
  const Scene& scene = scan("walk");
  const double round = scene.duration_s * 360.0 / 375.0;
  const Eigen::Isometry3d start = cameraPose(scene, 0.0), end = cameraPose(scene, round);
  EXPECT_LT((start.translation() - end.translation()).norm(), 2.0 * 2e-3 * std::sqrt(3.0));
  EXPECT_LT(angleBetween(start, end), 2.0 * 0.5 * std::sqrt(3.0) * kDegree);
  double lowest = M_PI, highest = 0.0, turned = 0.0, last = 0.0;
  for (double t = 0.0; t <= scene.duration_s; t += 0.05) {
    const SceneState state = scene.state(t);
    const Eigen::Vector3d from_body =
        state.T_world_camera->translation() - *state.T_world_camera * middleOf(state.vertices[0]);
    const double elevation = std::asin(from_body.normalized().z()),
                 azimuth = std::atan2(from_body.y(), from_body.x());
    lowest = std::min(lowest, elevation);
    highest = std::max(highest, elevation);
    if (t > 0.0) turned += std::remainder(azimuth - last, 2.0 * M_PI);
    last = azimuth;
  }
  EXPECT_NEAR(lowest, 30.0 * kDegree, 2.0 * kDegree);
  EXPECT_NEAR(highest, 60.0 * kDegree, 2.0 * kDegree);
  EXPECT_NEAR(turned, 375.0 * kDegree, 3.0 * kDegree);
}

TEST(Scans, TheHandTremblesAndIsPushedOnlySoMuch) {
  constexpr double kStep = 2e-3;  // [s]
  for (const bool jerks : {false, true}) {
    const Scene& scene = scan("walk", "sponge", jerks);
    double fastest = 0.0, quickest = 0.0;
    for (double t = 0.0; t < scene.duration_s; t += kStep) {
      const Eigen::Isometry3d now = cameraPose(scene, t), next = cameraPose(scene, t + kStep);
      fastest = std::max(fastest, (next.translation() - now.translation()).norm() / kStep);
      quickest = std::max(quickest, angleBetween(now, next) / kStep);
    }
    EXPECT_GT(fastest, jerks ? 0.3 : 0.15);
    EXPECT_LT(fastest, jerks ? 0.7 : 0.4);
    EXPECT_LT(quickest, 70.0 * kDegree);
  }
}

TEST(Scans, TheTurntableTurnsSheetAndBodyAlone) {
  const Scene& scene = scan("turntable");
  const std::size_t sheet = sheetOf(scene);
  const SceneState start = scene.state(0.0), later = scene.state(3.0);
  EXPECT_TRUE(start.vertices[1].isApprox(later.vertices[1]));
  EXPECT_TRUE(start.vertices[2].isApprox(later.vertices[2]));
  const Eigen::Isometry3d T_start = poseOf(scene.actors[sheet].rest.vertices, start.vertices[sheet]),
                          T_later = poseOf(scene.actors[sheet].rest.vertices, later.vertices[sheet]);
  EXPECT_NEAR(angleBetween(T_start, T_later), 3.0 / 20.0 * 730.0 * kDegree, 1e-6);
  EXPECT_TRUE((T_start.inverse() * start.T_camera_body).isApprox(T_later.inverse() * later.T_camera_body));
}

/// Everything but the sheet in coarse texture, which takes less time to prepare.
Scene plainScan(const std::string& name) {
  Scene scene = scan(name);
  for (std::size_t i = 0; i < scene.actors.size(); ++i) {
    if (i != sheetOf(scene)) scene.actors[i].texel_m = 0.01;
  }
  return scene;
}

TEST(Scans, TheHandHidesTheBodyAFewTimes) {
  const Pinhole small = d435(160, 120);
  const Scene scene = plainScan("walk_hand");
  VirtualCamera camera(scene, small, noNoise(), 1), bare(withoutHands(scene), small, noNoise(), 1);
  int hidden = 0;
  for (double t = 0.0; t < 20.0; t += 0.5) {
    const auto bodies = [&](VirtualCamera* of) { return cv::countNonZero(of->capture(0, t).labels == 3); };
    hidden += bodies(&camera) < 0.8 * bodies(&bare);
  }
  EXPECT_GE(hidden, 3);
  EXPECT_LE(hidden, 12);
}

/// The tracker of tools sees the sheet where it is, with all noise.
TEST(Scans, TheSheetIsTrackedWithinAMillimetre) {
  for (const char* name : {"walk", "flip", "turntable"}) {
    const Scene scene = plainScan(name);
    VirtualCamera camera(scene, kCamera, NoiseOptions(), 1);
    double squares = 0.0;
    int frames = 0;
    for (int frame = 0; frame < 600; frame += 90) {
      const double t = frame / 30.0;
      const Capture capture = camera.capture(frame, t);
      RgbdFrame seen;
      seen.stamp = 1 + frame * 33'333'333ll;
      seen.camera = kCamera;
      cv::cvtColor(capture.color, seen.color, cv::COLOR_RGB2BGR);
      capture.depth_mm.convertTo(seen.depth, CV_32F, 1e-3);
      ToolTracker tracker(shippedSheet());
      const auto found = tracker.track(seen, nullptr);
      ASSERT_TRUE(found) << name << " at " << t << ": " << tracker.reason();
      const std::size_t sheet = sheetOf(scene);
      const Eigen::Isometry3d truth =
          poseOf(scene.actors[sheet].rest.vertices, scene.state(t).vertices[sheet]);
      EXPECT_LT((found->T_camera_tool.translation() - truth.translation()).norm(), 1e-3)
          << name << " at " << t;
      const double angle = angleBetween(found->T_camera_tool, truth);
      EXPECT_LT(angle, 0.45 * kDegree) << name << " at " << t;
      squares += angle * angle;
      ++frames;
    }
    EXPECT_LT(std::sqrt(squares / frames), 0.2 * kDegree) << name;
  }
}

TEST(Scans, OptionsThatDoNotFitAreRefused) {
  CameraSetup setup;
  setup.config_folder = CONFIG_DIR;
  setup.scene = "bend";
  setup.jerks = true;
  EXPECT_THROW(makeCamera(setup), std::invalid_argument);
  for (const char* scene : {"turntable", "doll_turntable"}) {
    setup.scene = scene;
    EXPECT_THROW(makeCamera(setup), std::invalid_argument) << scene;
  }
  setup.jerks = false;
  EXPECT_NO_THROW(makeCamera(setup));
  setup.scene = "walk";
  setup.camera_motion = "orbit";
  EXPECT_THROW(makeCamera(setup), std::invalid_argument);
}

}  // namespace
}  // namespace softbody::virtual_camera
