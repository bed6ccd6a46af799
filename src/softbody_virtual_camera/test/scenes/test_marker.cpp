#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <opencv2/aruco.hpp>
#include <opencv2/calib3d.hpp>

#include "fixtures/scene_fixtures.h"
#include "scenes/tool.h"
#include "softbody_virtual_camera/camera/virtual_camera.h"

namespace softbody::virtual_camera {
namespace {

const std::string kKnife = std::string(CONFIG_DIR) + "/knife.yaml";
const Pinhole kMarkerCamera = d435(640, 480);

using Corners = std::vector<cv::Point2f>;  // from the top left clockwise [px]

/// A scene with everything but the marker in coarse texture, which takes less time to prepare.
Scene plainScene(const std::string& name) {
  Scene scene = makeScene(name, shippedBody(objectOf(name)), 1, kKnife);
  for (std::size_t i = 0; i + 1 < scene.actors.size(); ++i) scene.actors[i].texel_m = 0.01;
  return scene;
}

Points cornersOf(const ToolMarker& marker) {
  const double half = 0.5 * marker.size_m;
  Points corners(4, 3);
  corners << -half, half, 0, half, half, 0, half, -half, 0, -half, -half, 0;
  return corners;
}

Corners projected(const ToolMarker& marker, const Eigen::Isometry3d& T_camera_tool) {
  Corners pixels;
  const Points corners = transformed(T_camera_tool * marker.T_tool_marker, cornersOf(marker));
  for (Eigen::Index k = 0; k < 4; ++k) {
    const Eigen::Vector2d pixel = kMarkerCamera.project(corners.row(k).transpose());
    pixels.emplace_back(static_cast<float>(pixel.x()), static_cast<float>(pixel.y()));
  }
  return pixels;
}

/// Far enough from the image's border for its outline to be seen.
bool inView(const Corners& corners) {
  constexpr double kMargin = 3.0;  // [px]
  return std::all_of(corners.begin(), corners.end(), [&](const cv::Point2f& p) {
    return p.x > kMargin && p.y > kMargin && p.x < kMarkerCamera.width - kMargin &&
           p.y < kMarkerCamera.height - kMargin;
  });
}

double largestDistance(const Corners& a, const Corners& b) {
  double largest = 0.0;
  for (std::size_t k = 0; k < 4; ++k) largest = std::max(largest, cv::norm(a[k] - b[k]));
  return largest;
}

/// Detections of the marker, nothing else being there to detect.
std::vector<Corners> detect(const cv::Mat3b& color, int id) {
  const auto parameters = cv::aruco::DetectorParameters::create();
  parameters->cornerRefinementMethod = cv::aruco::CORNER_REFINE_SUBPIX;
  parameters->minMarkerDistanceRate = 0.02;
  std::vector<Corners> corners;
  std::vector<int> ids;
  cv::aruco::detectMarkers(color, cv::aruco::getPredefinedDictionary(cv::aruco::DICT_4X4_50), corners, ids,
                           parameters);
  for (const int found : ids) EXPECT_EQ(found, id);
  return corners;
}

/// The better one of the two poses of a square (Collins and Bartoli 2014).
Eigen::Isometry3d poseOf(const Corners& corners, const ToolMarker& marker) {
  std::vector<cv::Point3d> square;
  const Points own = cornersOf(marker);
  for (Eigen::Index k = 0; k < 4; ++k) square.emplace_back(own(k, 0), own(k, 1), own(k, 2));
  const cv::Matx33d matrix(kMarkerCamera.fx, 0, kMarkerCamera.cx, 0, kMarkerCamera.fy, kMarkerCamera.cy, 0, 0,
                           1);
  cv::Vec3d turn, translation;
  cv::solvePnP(square, corners, matrix, cv::noArray(), turn, translation, false, cv::SOLVEPNP_IPPE_SQUARE);
  cv::Matx33d rotation;
  cv::Rodrigues(turn, rotation);
  Eigen::Isometry3d T_camera_marker = Eigen::Isometry3d::Identity();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) T_camera_marker.linear()(i, j) = rotation(i, j);
    T_camera_marker.translation()[i] = translation[i];
  }
  return T_camera_marker * marker.T_tool_marker.inverse();
}

/// The detection that is nearest to where the marker is: its outline may be found twice.
const Corners* nearest(const std::vector<Corners>& found, const Corners& expected) {
  const auto closer = [&](const Corners& a, const Corners& b) {
    return largestDistance(a, expected) < largestDistance(b, expected);
  };
  const auto best = std::min_element(found.begin(), found.end(), closer);
  return best == found.end() ? nullptr : &*best;
}

class MarkerInCutScene : public testing::TestWithParam<std::string> {};

TEST_P(MarkerInCutScene, IsWhereTheTruthSaysWithoutNoise) {
  const ToolMarker marker = readTool(kKnife).markers.at(0);
  VirtualCamera camera(plainScene(GetParam()), kMarkerCamera, noNoise(), 1);
  int frames = 0;
  for (double t = 0.0; t < camera.scene().duration_s; t += 0.7) {
    const Capture capture = camera.capture(0, t);
    const Eigen::Isometry3d truth = *capture.T_camera_tool;
    const Corners expected = projected(marker, truth);
    if (!inView(expected)) continue;
    ++frames;
    const std::vector<Corners> found = detect(capture.color, marker.id);
    const Corners* corners = nearest(found, expected);
    ASSERT_NE(corners, nullptr) << "at " << t;
    EXPECT_LT(largestDistance(*corners, expected), 0.5) << "at " << t;
    const Eigen::Isometry3d error =
        (truth * marker.T_tool_marker).inverse() * poseOf(*corners, marker) * marker.T_tool_marker;
    EXPECT_LT(error.translation().norm(), 1e-3) << "at " << t;
    EXPECT_LT(Eigen::AngleAxisd(error.linear()).angle() * 180.0 / 3.14159265358979, 0.5) << "at " << t;
  }
  EXPECT_GE(frames, 5);
}

TEST_P(MarkerInCutScene, IsFoundInNearlyEveryNoisyFrame) {
  const ToolMarker marker = readTool(kKnife).markers.at(0);
  VirtualCamera camera(plainScene(GetParam()), kMarkerCamera, NoiseOptions(), 1);
  int frames = 0, found = 0;
  for (int frame = 0; frame / 30.0 < camera.scene().duration_s; frame += 5) {
    const Capture capture = camera.capture(frame, frame / 30.0);
    const Corners expected = projected(marker, *capture.T_camera_tool);
    if (!inView(expected)) continue;
    ++frames;
    const std::vector<Corners> detected = detect(capture.color, marker.id);
    const Corners* corners = nearest(detected, expected);
    found += corners != nullptr && largestDistance(*corners, expected) < 2.0;
  }
  EXPECT_GE(frames, 20);
  EXPECT_GE(found, 0.95 * frames) << found << " of " << frames;
}

INSTANTIATE_TEST_SUITE_P(, MarkerInCutScene,
                         testing::Values("cut", "cut-partial", "cut-cross", "doll_cut", "doll_cut-partial",
                                         "doll_cut-cross"));

TEST(Board, ThatIsTheBladeShowsItsMarkerWhileItCuts) {
  const std::string file = std::string(CONFIG_DIR) + "/board.yaml";
  const Scene scene = makeScene("cut", shippedBody("sponge"), 1, file);
  const ToolMarker marker = readTool(file).markers.at(0);
  for (double t = 0.5; t < 3.5; t += 0.5) {
    const Eigen::Isometry3d T_camera_marker = *scene.state(t).T_camera_tool * marker.T_tool_marker;
    EXPECT_LT(T_camera_marker.linear().col(2).dot(T_camera_marker.translation().normalized()), -0.5) << t;
  }
}

}  // namespace
}  // namespace softbody::virtual_camera
