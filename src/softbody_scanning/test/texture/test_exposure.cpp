#include "texture/exposure.h"

#include <gtest/gtest.h>

#include <random>

#include "fixtures/painted_ball.h"

namespace softbody::scanning {
namespace {

std::vector<double> randomGains(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> gain(0.8, 1.2);
  std::vector<double> gains(count);
  double logs = 0.0;
  for (double& value : gains) logs += std::log(value = gain(random));
  for (double& value : gains) value /= std::exp(logs / static_cast<double>(count));
  return gains;
}

TEST(Exposure, GainsOfTwentyPercentAreFound) {
  const TriangleMesh mesh = ballMesh();
  for (unsigned seed = 0; seed < 3; ++seed) {
    const std::vector<double> truth = randomGains(24, seed);
    const auto gains = exposureGains(findViews(mesh, walkAround(mesh, truth), 0.005), 24);
    for (std::size_t f = 0; f < 24; ++f) {
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(gains[f][k], truth[f], 0.01 * truth[f]) << seed << ' ' << f;
    }
  }
}

TEST(Exposure, AHandInSomeFramesDoesNotDisturb) {
  const TriangleMesh mesh = ballMesh();
  const std::vector<double> truth = randomGains(24, 7);
  std::vector<KeyFrame> frames = walkAround(mesh, truth);
  for (std::size_t f = 0; f < 24; f += 3)
    cv::Mat3b(frames[f].color, cv::Rect(100, 0, 40, 240)).setTo(cv::Vec3b(20, 20, 200));
  const auto gains = exposureGains(findViews(mesh, frames, 0.005), 24);
  for (std::size_t f = 0; f < 24; ++f) EXPECT_NEAR(gains[f][1], truth[f], 0.02 * truth[f]) << f;
}

TEST(Exposure, AFrameWithoutOverlapKeepsItsExposure) {
  const TriangleMesh mesh = ballMesh();
  const auto gains = exposureGains(findViews(mesh, {ballFrame(mesh, {1, 0, 0}, 1.2)}, 0.005), 1);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(gains[0][k], 1.0, 1e-6);
}

}  // namespace
}  // namespace softbody::scanning
