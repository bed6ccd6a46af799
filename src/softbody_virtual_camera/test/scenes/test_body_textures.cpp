#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <functional>
#include <opencv2/imgproc.hpp>
#include <random>

#include "fixtures/scene_fixtures.h"
#include "softbody_common/statistics/random.h"
#include "softbody_virtual_camera/camera/virtual_camera.h"
#include "softbody_virtual_camera/rendering/renderer.h"
#include "textures/body_paint.h"

namespace softbody::virtual_camera {
namespace {

const Pinhole kTextureCamera = d435(640, 480);
constexpr double kHalfLength = 0.1, kHalfWidth = 0.05, kHalfThickness = 0.02;  // of the sponge [m]

Scene texturedScene(const std::string& name, const std::string& texture, std::uint64_t seed = 1) {
  return withoutHands(makeScene(name, shippedBody(objectOf(name)), seed, "", texture));
}

using Inside = std::function<bool(const Eigen::Vector3d& place)>;

/// Colours of the pixels whose place in the body's frame is inside, in a frame without noise.
std::vector<cv::Vec3b> colorsOf(const Scene& scene, double t, const Inside& inside) {
  RenderedImage image;
  const SceneState state = scene.state(t);
  Renderer(scene, kTextureCamera).render(state, &image);
  const Eigen::Isometry3d T_body_camera = state.T_camera_body.inverse();
  std::vector<cv::Vec3b> colors;
  for (int v = 0; v < image.depth.rows; ++v) {
    for (int u = 0; u < image.depth.cols; ++u) {
      if (inside(T_body_camera * kTextureCamera.unproject(u, v, image.depth(v, u))))
        colors.push_back(image.color(v, u));
    }
  }
  return colors;
}

bool onTop(const Eigen::Vector3d& p) {
  return std::abs(p.x()) < 0.95 * kHalfLength && std::abs(p.y()) < 0.9 * kHalfWidth &&
         std::abs(p.z() - kHalfThickness) < 1e-4;
}

bool onSide(const Eigen::Vector3d& p) {
  return std::abs(p.x()) < 0.95 * kHalfLength && std::abs(p.y() + kHalfWidth) < 1e-4 &&
         std::abs(p.z()) < 0.9 * kHalfThickness;
}

/// Range of the green values.
int rangeOf(const std::vector<cv::Vec3b>& colors) {
  int low = 255, high = 0;
  for (const cv::Vec3b& color : colors) {
    low = std::min<int>(low, color[1]);
    high = std::max<int>(high, color[1]);
  }
  return high - low;
}

/// Standard deviation of the green values over their mean.
double relativeDeviation(const std::vector<cv::Vec3b>& colors) {
  cv::Scalar mean, deviation;
  cv::meanStdDev(cv::Mat(colors), mean, deviation);
  return deviation[1] / mean[1];
}

TEST(BodyTexture, RichIsThePatternItself) {
  const Scene scene = texturedScene("bend", "rich", 7);
  const Texture pattern = cellTexture(hash(7, 1));
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-kHalfLength, kHalfLength);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d p(place(random), place(random), place(random));
    EXPECT_EQ(scene.actors[0].texture(p), pattern(p));
  }
  const auto capture = [](const Scene& shown) {
    return VirtualCamera(shown, kTextureCamera, NoiseOptions(), 7).capture(40, 40.0 / 30.0);
  };
  const Capture named = capture(scene), usual = capture(makeScene("bend", shippedBody("sponge"), 7));
  EXPECT_EQ(cv::norm(named.color, usual.color, cv::NORM_INF), 0.0);
}

TEST(BodyTexture, PlainFacesHaveOneColourEachAndDifferFromOneAnother) {
  for (const double t : {0.0, 2.5}) {
    const Scene scene = texturedScene("rigid", "plain");
    const std::vector<cv::Vec3b> top = colorsOf(scene, t, onTop), side = colorsOf(scene, t, onSide);
    ASSERT_GT(top.size(), 10000u);
    ASSERT_GT(side.size(), 1000u);
    EXPECT_EQ(rangeOf(top), 0) << "at " << t;
    EXPECT_EQ(rangeOf(side), 0) << "at " << t;
    EXPECT_GT(std::abs(top[0][1] - side[0][1]), 15) << "at " << t;
  }
}

TEST(BodyTexture, ADentInAPlainFaceShowsAsShading) {
  const Scene scene = texturedScene("press", "plain");
  const Inside upper = [](const Eigen::Vector3d& p) {
    return std::abs(p.x()) < 0.9 * kHalfLength && std::abs(p.y()) < 0.8 * kHalfWidth && p.z() > 0.0 &&
           p.z() < kHalfThickness + 1e-4;
  };
  EXPECT_EQ(rangeOf(colorsOf(scene, 0.0, upper)), 0);
  EXPECT_GT(rangeOf(colorsOf(scene, 2.5, upper)), 20);
}

TEST(BodyTexture, WeakHasAContrastOfAFewPercent) {
  const auto contrast = [](const std::string& texture) {
    return relativeDeviation(colorsOf(texturedScene("still", texture), 0.0, onTop));
  };
  EXPECT_GT(contrast("rich"), 0.2);
  EXPECT_GT(contrast("weak"), 0.02);
  EXPECT_LT(contrast("weak"), 0.06);
}

TEST(BodyTexture, ASpongeIsYellowWithDarkPores) {
  const auto colors = colorsOf(texturedScene("still", "sponge"), 0.0, onTop);
  EXPECT_GT(relativeDeviation(colors), 0.1);
  for (const cv::Vec3b& color : colors) {  // red, green, blue
    EXPECT_GE(color[0], color[1]);
    EXPECT_GT(color[1], color[2]);
  }
}

TEST(BodyTexture, APlainDollHasOneHue) {
  Scene scene = texturedScene("doll_bend", "plain");
  const SceneState state = scene.state(1.5);
  RenderedImage image;
  Renderer(scene, kTextureCamera).render(state, &image);
  Scene alone = scene;
  alone.actors.resize(1);
  alone.state = [&](double) { return SceneState{state.T_camera_body, {state.vertices[0]}}; };
  RenderedImage own;
  Renderer(alone, kTextureCamera).render(alone.state(0.0), &own);
  cv::Mat1b inside = own.depth > 0.0f;
  cv::erode(inside, inside, cv::Mat1b::ones(5, 5));
  const Eigen::Vector3f color = plainColor();
  int count = 0, low = 255, high = 0;
  for (int v = 0; v < image.color.rows; ++v) {
    for (int u = 0; u < image.color.cols; ++u) {
      if (!inside(v, u)) continue;
      const cv::Vec3b& seen = image.color(v, u);
      EXPECT_NEAR(seen[0], seen[1] * color.x() / color.y(), 2.0);
      EXPECT_NEAR(seen[2], seen[1] * color.z() / color.y(), 2.0);
      low = std::min<int>(low, seen[1]);
      high = std::max<int>(high, seen[1]);
      ++count;
    }
  }
  EXPECT_GT(count, 10000);
  EXPECT_GT(high - low, 40);
}

TEST(BodyTexture, ABodysPicturesFadeAroundTheirMeanAndAreGoneIfPlain) {
  cv::Mat3b image(64, 64);
  cv::theRNG().state = 5;
  cv::randu(image, 0, 255);
  const UvTexture skin{Points::Zero(3, 3), {0}, {makePicture(image)}};
  EXPECT_FALSE(withContrast(skin, paintOf("plain").contrast).covers(0));
  const UvTexture weak = withContrast(skin, paintOf("weak").contrast);
  ASSERT_TRUE(weak.covers(0));
  cv::Scalar mean, deviation, weak_mean, weak_deviation;
  cv::meanStdDev(image, mean, deviation);
  cv::meanStdDev(weak.pictures[0][0], weak_mean, weak_deviation);
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(weak_mean[k], mean[k], 1.0);
    EXPECT_NEAR(weak_deviation[k], paintOf("weak").contrast * deviation[k], 0.5);
  }
  EXPECT_EQ(cv::norm(withContrast(skin, paintOf("rich").contrast).pictures[0][0], image, cv::NORM_INF), 0.0);
  EXPECT_THROW(paintOf("glossy"), std::invalid_argument);
}

}  // namespace
}  // namespace softbody::virtual_camera
