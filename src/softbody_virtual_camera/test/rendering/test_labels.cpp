#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "camera/camera_motion.h"
#include "fixtures/scene_fixtures.h"
#include "softbody_common/images/pixel_labels.h"
#include "softbody_common/images/rasterizer.h"
#include "softbody_virtual_camera/camera/virtual_camera.h"

namespace softbody::virtual_camera {
namespace {

const Pinhole kLabelCamera = d435(320, 240);
constexpr float kSameSurface_m = 1e-4f;

/// Depth of the actors from `first` to before `end`, drawn by another rasterizer; 0: nothing.
cv::Mat1f depthOf(const Scene& scene, const SceneState& state, std::size_t first, std::size_t end) {
  cv::Mat1f nearest = cv::Mat1f::zeros(kLabelCamera.height, kLabelCamera.width);
  RasterImage image;
  for (std::size_t i = first; i < end; ++i) {
    rasterize(kLabelCamera, state.vertices[i], scene.actors[i].rest.triangles, &image);
    const cv::Mat1b nearer = (image.depth > 0.0f) & ((nearest == 0.0f) | (image.depth < nearest));
    image.depth.copyTo(nearest, nearer);
  }
  return nearest;
}

/// The depth of a pixel is that of the surface with its label; some pixels at edges are left out.
void expectLabels(const Scene& scene, double t) {
  const SceneState state = scene.state(t);
  RenderedImage image;
  Renderer(scene, kLabelCamera).render(state, &image);
  std::map<std::uint8_t, cv::Mat1f> of_label = {
      {labels::kBackground, depthOf(scene, state, 1, 3)},
      {labels::kBody, depthOf(scene, state, 0, 1)},
      {labels::kOccluder, depthOf(scene, state, 3, scene.actors.size())}};
  std::map<std::uint8_t, int> seen;
  int unclear = 0;
  for (int v = 0; v < image.labels.rows; ++v) {
    for (int u = 0; u < image.labels.cols; ++u) {
      const std::uint8_t label = image.labels(v, u);
      ASSERT_EQ(of_label.count(label), 1u);
      ++seen[label];
      const float z = image.depth(v, u);
      const float expected = of_label[label](v, u);  // 0 behind the table and the wall, where z is 0 too
      const bool on_surface = std::abs(expected - z) < kSameSurface_m;
      unclear += !on_surface;
    }
  }
  EXPECT_LT(unclear, 60) << scene.name << " at " << t;
  EXPECT_GT(seen[labels::kBody], 1000) << scene.name;
  EXPECT_GT(seen[labels::kOccluder], 500) << scene.name;
  EXPECT_GT(seen[labels::kBackground], 10000) << scene.name;
}

TEST(Labels, AreThoseOfTheSurfaceWhoseDepthIsSeen) {
  for (const std::string name : {"touch", "occlude", "press", "doll_touch"}) {
    const Scene scene = makeScene(name, shippedBody(objectOf(name)), 1);
    expectLabels(scene, 2.0);
    if (name == "touch") expectLabels(withCameraMotion("orbit", scene), 2.0);
  }
}

TEST(Labels, AreFreeOfNoise) {
  const Scene scene = makeScene("touch", shippedBody("sponge"), 1);
  VirtualCamera noisy(scene, kLabelCamera, NoiseOptions(), 1), clean(scene, kLabelCamera, noNoise(), 1);
  const Capture a = noisy.capture(60, 2.0), b = clean.capture(60, 2.0);
  EXPECT_EQ(cv::norm(a.labels, b.labels, cv::NORM_INF), 0.0);
  EXPECT_GT(cv::norm(a.depth_mm, b.depth_mm, cv::NORM_INF), 0.0);
}

TEST(Labels, OfAToolAreAnOccluder) {
  const Scene scene = makeScene("cut", shippedBody("sponge"), 1, std::string(CONFIG_DIR) + "/knife.yaml");
  VirtualCamera camera(scene, kLabelCamera, noNoise(), 1);
  const Capture capture = camera.capture(75, 2.5);
  EXPECT_GT(cv::countNonZero(capture.labels == labels::kOccluder), 200);
  EXPECT_GT(cv::countNonZero(capture.labels == labels::kBody), 1000);
}

}  // namespace
}  // namespace softbody::virtual_camera
