#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

#include "camera/depth_registration.h"
#include "softbody_tracking/camera/camera_ingest.h"

namespace softbody {
namespace {

const Pinhole kDepthCamera{160, 144, 126.0, 126.0, 80.0, 72.0},
    kColorCamera{320, 180, 150.0, 151.0, 161.0, 88.0};

/// z of the plane normal . p = offset behind each pixel.
cv::Mat1f planeDepth(const Pinhole& camera, const Eigen::Vector3d& normal, double offset) {
  cv::Mat1f depth(camera.height, camera.width);
  depth.forEach([&](float& z, const int* at) {
    z = static_cast<float>(offset / normal.dot(camera.unproject(at[1], at[0], 1.0)));
  });
  return depth;
}

Eigen::Isometry3d randomPose(std::mt19937* random) {
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  const Eigen::Vector3d axis(number(*random), number(*random), number(*random));
  return Eigen::Translation3d(0.05 * number(*random), 0.03 * number(*random), 0.02 * number(*random)) *
         Eigen::AngleAxisd(0.1 * number(*random), axis.normalized());
}

TEST(DepthRegistration, TheSameCameraKeepsEveryPixel) {
  const cv::Mat1f depth = planeDepth(kDepthCamera, {0.0, 0.0, 1.0}, 0.7);
  const cv::Mat1f registered =
      registeredDepth(depth, kDepthCamera, Eigen::Isometry3d::Identity(), kDepthCamera);
  EXPECT_EQ(cv::norm(registered, depth, cv::NORM_INF), 0.0);
}

/// Inside of the depth camera's view there is no gap, and z is that of the plane within a pixel's slope.
TEST(DepthRegistration, APlaneIsThePlaneThatTheOtherCameraSees) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> tilt(-0.5, 0.5);
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::Vector3d normal = Eigen::Vector3d(tilt(random), tilt(random), 1.0).normalized();
    const Eigen::Isometry3d T = randomPose(&random);
    const Eigen::Vector3d color_normal = T.linear() * normal;
    const cv::Mat1f expected =
        planeDepth(kColorCamera, color_normal, 0.6 + color_normal.dot(T.translation()));
    const cv::Mat1f registered =
        registeredDepth(planeDepth(kDepthCamera, normal, 0.6), kDepthCamera, T, kColorCamera);
    int inside = 0;
    for (int v = 0; v < expected.rows; ++v) {
      for (int u = 0; u < expected.cols; ++u) {
        const Eigen::Vector3d seen = T.inverse() * kColorCamera.unproject(u, v, expected(v, u));
        const Eigen::Vector2d pixel = kDepthCamera.project(seen);
        if (!kDepthCamera.contains(pixel.x() - 1.0, pixel.y() - 1.0) ||
            !kDepthCamera.contains(pixel.x() + 1.0, pixel.y() + 1.0))
          continue;
        ++inside;
        ASSERT_NEAR(registered(v, u), expected(v, u), 0.015) << trial << ": " << u << " " << v;
      }
    }
    EXPECT_GT(inside, 10000);
  }
}

TEST(DepthRegistration, TheNearestSurfaceIsKept) {
  cv::Mat1f depth(kDepthCamera.height, kDepthCamera.width, 2.0f);
  depth(cv::Rect(60, 50, 40, 40)) = 0.5f;
  const Eigen::Isometry3d T(Eigen::Translation3d(0.05, 0.0, 0.0));
  const cv::Mat1f registered = registeredDepth(depth, kDepthCamera, T, kColorCamera);
  const Eigen::Vector2d centre = kColorCamera.project(T * kDepthCamera.unproject(80, 70, 0.5));
  const cv::Rect near(static_cast<int>(centre.x()) - 15, static_cast<int>(centre.y()) - 15, 30, 30);
  EXPECT_EQ(cv::countNonZero(registered(near) != 0.5f), 0);
}

TEST(DepthRegistration, AnotherSizeThanTheCamerasIsRefused) {
  EXPECT_THROW(registeredDepth(cv::Mat1f(3, 4), kDepthCamera, Eigen::Isometry3d::Identity(), kColorCamera),
               std::invalid_argument);
}

/// Millimetres of a depth camera with its own lens, turned and shifted, end in the rectified colour camera.
TEST(DepthRegistration, TheIngestRegistersDepthOfAnotherCamera) {
  DepthCamera depth_camera{kDepthCamera, {}, Eigen::Isometry3d(Eigen::Translation3d(-0.03, 0.0, 0.0))};
  cv::Mat1w millimetres(kDepthCamera.height, kDepthCamera.width, std::uint16_t{800});
  const cv::Mat3b color(kColorCamera.height, kColorCamera.width, cv::Vec3b(1, 2, 3));
  const RgbdFrame frame = CameraIngest({}).process({color, millimetres, {}, kColorCamera, 1, depth_camera});
  EXPECT_EQ(frame.depth.size(), color.size());
  EXPECT_FLOAT_EQ(frame.depth(88, 161), 0.8f);
  EXPECT_TRUE(std::isnan(frame.depth(88, 0))) << "outside of the depth camera's view";
  EXPECT_THROW(CameraIngest({}).process({color, cv::Mat1w(3, 4), {}, kColorCamera, 1, depth_camera}),
               std::invalid_argument);
}

}  // namespace
}  // namespace softbody
