#include "softbody_virtual_camera/rendering/exposure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "fixtures/scene_fixtures.h"
#include "softbody_virtual_camera/camera/virtual_camera.h"

namespace softbody::virtual_camera {
namespace {

const Pinhole kSharpCamera = d435(640, 480);

/// A black square that flies to the right at this speed before a white wall.
Scene flyingSquare(double speed) {
  Scene scene = stillScene({{rectangleMesh(0.1, 0.1), uniformTexture(0.0f), 0.1},
                            {rectangleMesh(2.0, 2.0), uniformTexture(1.0f), 0.1}},
                           {Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, 0.5)),
                            Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, 1.0))});
  scene.state = [=, start = scene.state(0.0)](double t) {
    SceneState state = start;
    state.vertices[0].col(0).array() += speed * (t - 1.0);
    return state;
  };
  return scene;
}

NoiseOptions onlyBlur() {
  NoiseOptions noise = noNoise();
  noise.blur.enabled = true;
  return noise;
}

/// Pixels of the middle row that are neither black nor white, at each of the square's two edges.
int grayPixels(const cv::Mat3b& color) {
  int count = 0;
  for (int u = 0; u < color.cols; ++u)
    count += color(240, u)[1] > 8 && color(240, u)[1] < color(20, 20)[1] - 8;
  return count / 2;
}

TEST(MotionBlur, SmearsAnEdgeOverTheWayThatItMovesDuringTheExposure) {
  for (const double speed : {-1.0, 0.7}) {
    const Capture sharp = VirtualCamera(flyingSquare(speed), kSharpCamera, noNoise(), 1).capture(0, 1.0);
    const Capture blurred = VirtualCamera(flyingSquare(speed), kSharpCamera, onlyBlur(), 1).capture(0, 1.0);
    const double way = std::abs(speed) * MotionBlurOptions().exposure_s * kSharpCamera.fx / 0.5;
    EXPECT_LE(grayPixels(sharp.color), 1);
    EXPECT_NEAR(grayPixels(blurred.color), way, 0.25 * way + 1.0);
    EXPECT_EQ(cv::norm(sharp.depth_mm, blurred.depth_mm, cv::NORM_INF), 0.0);
    EXPECT_EQ(sharp.truth.vertices, blurred.truth.vertices);
    // The smear lies around the stamp's place: as much dark as without.
    EXPECT_NEAR(cv::mean(blurred.color)[1], cv::mean(sharp.color)[1], 0.2);
  }
}

TEST(MotionBlur, LeavesWhatStandsStillSharp) {
  const Capture sharp = VirtualCamera(flyingSquare(0.0), kSharpCamera, noNoise(), 1).capture(0, 1.0);
  const Capture blurred = VirtualCamera(flyingSquare(0.0), kSharpCamera, onlyBlur(), 1).capture(0, 1.0);
  EXPECT_EQ(cv::norm(sharp.color, blurred.color, cv::NORM_INF), 0.0);
}

TEST(MotionBlur, TakesMoreImagesForLongerWaysUpToItsLimit) {
  MotionBlurOptions options;
  EXPECT_EQ(blurImages(options, 0.0), 1);
  EXPECT_EQ(blurImages(options, 2.0 * options.step_px), 2);
  EXPECT_EQ(blurImages(options, 1e9), options.max_images);
  options.enabled = false;
  EXPECT_EQ(blurImages(options, 1e9), 1);
}

TEST(ExposureDrift, WandersSlowlyWithinItsLimitsAndDependsOnTheSeed) {
  const ExposureDriftOptions options;
  const auto mean = [&](double t, std::uint64_t seed) {
    cv::Mat3b color(4, 4, cv::Vec3b(100, 200, 100));
    ExposureDrift(options, seed).apply(t, &color);
    return cv::mean(color);
  };
  double least = 1e9, most = 0.0;
  for (double t = 0.0; t < 60.0; t += 0.1) {
    const double green = mean(t, 1)[1];
    EXPECT_NEAR(green, 200.0, 200.0 * options.exposure + 1.0);
    EXPECT_NEAR(mean(t, 1)[0] / green, 0.5, 0.5 * options.white_balance + 0.01);
    EXPECT_NEAR(mean(t + 1.0 / 30.0, 1)[1], green, 1.0) << "at " << t;
    least = std::min(least, green);
    most = std::max(most, green);
  }
  EXPECT_GT(most - least, 200.0 * options.exposure);
  EXPECT_NE(mean(3.0, 1), mean(3.0, 2));
  EXPECT_EQ(mean(3.0, 1), mean(3.0, 1));
}

}  // namespace
}  // namespace softbody::virtual_camera
