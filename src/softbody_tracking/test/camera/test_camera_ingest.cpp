#include <test_support/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include <yaml-cpp/yaml.h>

#include "softbody_tracking/camera/camera_ingest.h"

namespace softbody {
namespace {

const Pinhole kCamera{160, 120, 140.0, 141.0, 79.0, 60.5};

cv::Matx33d matrixOf(const Pinhole& camera) {
  return {camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0};
}

Distortion distorted(std::vector<double> coefficients, bool fisheye = false) {
  Distortion distortion;
  distortion.K = matrixOf(kCamera);
  distortion.coefficients = std::move(coefficients);
  distortion.fisheye = fisheye;
  return distortion;
}

/// Where the raw camera sees a rectified pixel, by OpenCV's projection rather than its maps.
cv::Point2d rawPixel(const Distortion& distortion, double u, double v) {
  const cv::Vec3d ray =
      distortion.R.t() * cv::Vec3d((u - kCamera.cx) / kCamera.fx, (v - kCamera.cy) / kCamera.fy, 1.0);
  const std::vector<cv::Point3d> points{{ray[0], ray[1], ray[2]}};
  std::vector<cv::Point2d> pixels;
  const cv::Vec3d none(0.0, 0.0, 0.0);
  if (distortion.fisheye) {
    cv::fisheye::projectPoints(points, pixels, none, none, distortion.K, distortion.coefficients);
  } else {
    cv::projectPoints(points, none, none, distortion.K, distortion.coefficients, pixels);
  }
  return pixels[0];
}

/// An image whose red and green say where a raw pixel was.
cv::Mat3b coordinateImage() {
  cv::Mat3b image(kCamera.height, kCamera.width);
  image.forEach([](cv::Vec3b& pixel, const int* at) {
    pixel = cv::Vec3b(0, static_cast<uchar>(at[0]), static_cast<uchar>(at[1]));
  });
  return image;
}

/// Smooth, and different at every pixel.
cv::Mat1f coordinateDepth() {
  cv::Mat1f depth(kCamera.height, kCamera.width);
  depth.forEach([](float& z, const int* at) {
    z = 1.0f + 0.001f * static_cast<float>(at[1]) + 0.002f * static_cast<float>(at[0]);
  });
  return depth;
}

TEST(CameraIngest, UndistortedImagesPassUnchanged) {
  CameraIngest ingest({});
  const cv::Mat3b color = coordinateImage();
  const RgbdFrame frame = ingest.process({color, coordinateDepth(), distorted({0, 0, 0, 0, 0}), kCamera, 42});
  EXPECT_EQ(frame.stamp, 42);
  EXPECT_EQ(frame.camera, kCamera);
  EXPECT_EQ(cv::norm(frame.color, color, cv::NORM_INF), 0.0);
  EXPECT_EQ(cv::norm(frame.depth, coordinateDepth(), cv::NORM_INF), 0.0);
}

TEST(CameraIngest, MillimetresBecomeMetresWithinTheRange) {
  cv::Mat1w millimetres(kCamera.height, kCamera.width);
  const auto value = [](int v) { return static_cast<std::uint16_t>(v < 40 ? 50 : v < 80 ? 750 : 6000); };
  millimetres.forEach([&](std::uint16_t& z, const int* at) { z = value(at[0]); });
  CameraIngest ingest({});
  const RgbdFrame frame = ingest.process({coordinateImage(), millimetres, distorted({}), kCamera, 0});
  for (int v = 0; v < kCamera.height; ++v) {
    if (v >= 40 && v < 80)
      EXPECT_FLOAT_EQ(frame.depth(v, 70), 0.75f) << v;
    else
      EXPECT_TRUE(std::isnan(frame.depth(v, 70))) << v;
  }
}

TEST(CameraIngest, OnlyDepthsInRangeAndNaNReachTheFrame) {
  cv::Mat1f depth(kCamera.height, kCamera.width, 0.8f);
  depth.row(10) = std::numeric_limits<float>::quiet_NaN();
  depth.row(20) = std::numeric_limits<float>::infinity();
  depth.row(30) = -1.0f;
  CameraIngest ingest({});
  const RgbdFrame frame = ingest.process({coordinateImage(), depth, distorted({}), kCamera, 0});
  for (int v = 0; v < kCamera.height; ++v)
    for (int u = 0; u < kCamera.width; ++u)
      ASSERT_TRUE(v == 10 || v == 20 || v == 30 ? std::isnan(frame.depth(v, u)) : frame.depth(v, u) == 0.8f)
          << u << " " << v;
  const RgbdFrame blind = ingest.process({coordinateImage(), cv::Mat(), distorted({}), kCamera, 0});
  EXPECT_EQ(blind.depth.size(), blind.color.size());
  for (const float z : blind.depth) EXPECT_TRUE(std::isnan(z));
}

/// So that a message's memory need not be filled twice.
TEST(CameraIngest, DepthIsWrittenIntoTheMemoryThatIsGiven) {
  DepthCamera other{kCamera, {}, Eigen::Isometry3d(Eigen::Translation3d(0.01, 0.0, 0.0))};
  for (const Distortion& distortion : {distorted({}), distorted({-0.3, 0.1, 0.001, -0.002})}) {
    for (const auto& depth_camera : {std::optional<DepthCamera>(), std::optional(other)}) {
      CameraIngest ingest({});
      const CameraImages images{coordinateImage(), coordinateDepth(), distortion, kCamera, 0, depth_camera};
      cv::Mat1f depth(kCamera.height, kCamera.width, -1.0f);
      const cv::Mat1f memory = depth;
      ingest.depth(images, &depth);
      EXPECT_EQ(depth.data, memory.data);
      const cv::Mat1f expected = ingest.process(images).depth;
      EXPECT_EQ(std::memcmp(memory.data, expected.data, memory.total() * sizeof(float)), 0);
    }
  }
}

class Rectification : public testing::TestWithParam<Distortion> {};

TEST_P(Rectification, ColourIsBilinearAndDepthNearestAtTheProjectedPixel) {
  const Distortion& distortion = GetParam();
  CameraIngest ingest({});
  const RgbdFrame frame = ingest.process({coordinateImage(), coordinateDepth(), distortion, kCamera, 0});
  int compared = 0;
  for (int v = 0; v < kCamera.height; v += 3) {
    for (int u = 0; u < kCamera.width; u += 3) {
      const cv::Point2d raw = rawPixel(distortion, u, v);
      if (raw.x < 1.0 || raw.y < 1.0 || raw.x > kCamera.width - 2.0 || raw.y > kCamera.height - 2.0) continue;
      ++compared;
      EXPECT_NEAR(frame.color(v, u)[2], raw.x, 0.6);
      EXPECT_NEAR(frame.color(v, u)[1], raw.y, 0.6);
      const cv::Vec3d ray =
          distortion.R.t() * cv::Vec3d((u - kCamera.cx) / kCamera.fx, (v - kCamera.cy) / kCamera.fy, 1.0);
      EXPECT_NEAR(frame.depth(v, u) * ray[2], 1.0 + 0.001 * raw.x + 0.002 * raw.y, 0.0017);
    }
  }
  EXPECT_GT(compared, 800);
}

Distortion rotated(Distortion distortion) {
  cv::Rodrigues(cv::Vec3d(0.02, -0.03, 0.05), distortion.R);
  return distortion;
}

INSTANTIATE_TEST_SUITE_P(Models, Rectification,
                         testing::Values(distorted({0.2624, -0.9531, -0.0054, 0.0026, 1.1633}),
                                         distorted({-0.3, 0.1, 0.001, -0.002}),
                                         distorted({0.5, 0.1, 0.001, -0.001, 0.01, 0.6, 0.2, 0.02}),
                                         distorted({0.05, -0.02, 0.01, -0.001}, true),
                                         rotated(distorted({-0.1, 0.02, 0.0, 0.0, 0.0})),
                                         rotated(distorted({}))));

TEST(CameraIngest, ANewCameraReplacesTheMaps) {
  const Distortion a = distorted({-0.3, 0.1, 0.0, 0.0}), b = distorted({0.2, 0.0, 0.0, 0.0});
  CameraIngest fresh({}), used({});
  used.process({coordinateImage(), coordinateDepth(), a, kCamera, 0});
  EXPECT_THROW(used.process({coordinateImage(), coordinateDepth(), distorted({1, 2, 3}), kCamera, 0}),
               std::invalid_argument);
  const RgbdFrame expected = fresh.process({coordinateImage(), coordinateDepth(), b, kCamera, 0});
  const RgbdFrame actual = used.process({coordinateImage(), coordinateDepth(), b, kCamera, 0});
  EXPECT_EQ(cv::norm(actual.color, expected.color, cv::NORM_INF), 0.0);
  EXPECT_EQ(cv::norm(actual.depth, expected.depth, cv::NORM_INF), 0.0);
}

TEST(CameraIngest, SaysWhatDoesNotFit) {
  CameraIngest ingest({});
  const cv::Mat3b color = coordinateImage();
  const auto sentence = [&](const cv::Mat3b& c, const cv::Mat& d,
                            const Distortion& distortion) -> std::string {
    return complaint([&] { ingest.process({c, d, distortion, kCamera, 0}); });
  };
  EXPECT_TRUE(says(sentence(color, cv::Mat1w(60, 80), distorted({})), "80x60"));
  EXPECT_TRUE(says(sentence(color, cv::Mat1b(120, 160), distorted({})), "CV_8UC1"));
  EXPECT_TRUE(says(sentence(cv::Mat3b(60, 80), cv::Mat(), distorted({})), "camera_info says 160x120"));
  EXPECT_TRUE(says(sentence(cv::Mat3b(), cv::Mat(), distorted({})), "empty"));
  EXPECT_TRUE(says(sentence(color, cv::Mat(), distorted({1, 0, 0})), "3 distortion"));
  EXPECT_TRUE(says(sentence(color, cv::Mat(), distorted({1, 0, 0, 0, 0}, true)), "equidistant"));
  EXPECT_TRUE(says(sentence(color, cv::Mat(), distorted({NAN, 0, 0, 0})), "finite"));
  Distortion no_focal_length = distorted({0.1, 0, 0, 0});
  no_focal_length.K = cv::Matx33d::zeros();
  EXPECT_TRUE(says(sentence(color, cv::Mat(), no_focal_length), "focal"));
}

TEST(CameraIngest, ParametersHaveLimits) {
  const auto refused = [](const char* yaml) {
    Parameters parameters(YAML::Load(yaml));
    EXPECT_THROW(cameraIngestParameters().read(parameters), std::invalid_argument) << yaml;
  };
  refused("min_depth_m: -1");
  refused("{min_depth_m: 2, max_depth_m: 1}");
}

}  // namespace
}  // namespace softbody
