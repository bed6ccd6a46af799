#include "softbody_virtual_camera/rendering/renderer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "fixtures/scene_fixtures.h"
#include "softbody_virtual_camera/camera/virtual_camera.h"
#include "softbody_virtual_camera/rendering/noise.h"

namespace softbody::virtual_camera {
namespace {

const Pinhole kCamera = d435(640, 480);

Actor sponge(float level = 1.0f) { return {shippedBody("sponge").rest, uniformTexture(level), 5e-3}; }

Eigen::Isometry3d pose(double x, double y, double z, double degrees, const Eigen::Vector3d& axis) {
  return Eigen::Translation3d(x, y, z) *
         Eigen::AngleAxisd(degrees * 3.14159265358979 / 180.0, axis.normalized());
}

RenderedImage render(const Scene& scene) {
  RenderedImage image;
  Renderer(scene, kCamera).render(scene.state(0.0), &image);
  return image;
}

TEST(Renderer, DepthOfATiltedPlaneIsExactAndUnbiasedInMillimetres) {
  const Eigen::Isometry3d T = pose(0.0, 0.0, 0.5, 25.0, {1.0, 0.3, 0.0});
  const RenderedImage image = render(stillScene({{rectangleMesh(0.1, 0.1), uniformTexture(0.5f)}}, {T}));
  const cv::Mat1w millimetres = toMillimetres(image.depth);
  const Eigen::Vector3d normal = T.linear().col(2);
  double sum = 0.0;
  int count = 0;
  for (int v = 0; v < kCamera.height; ++v) {
    for (int u = 0; u < kCamera.width; ++u) {
      if (image.depth(v, u) == 0.0f) continue;
      const double expected = normal.dot(T.translation()) / normal.dot(kCamera.unproject(u, v, 1.0));
      EXPECT_NEAR(image.depth(v, u), expected, 1e-6);
      sum += 1e-3 * millimetres(v, u) - expected;
      ++count;
    }
  }
  EXPECT_GT(count, 30000);
  EXPECT_NEAR(sum / count, 0.0, 0.1e-3);
}

TEST(Renderer, TheNearerSurfaceWinsWhateverTheOrder) {
  const Actor far{rectangleMesh(0.3, 0.3), uniformTexture(0.2f)},
      near{rectangleMesh(0.05, 0.05), uniformTexture(0.8f)};
  const Eigen::Isometry3d far_pose = pose(0, 0, 0.8, 0, {1, 0, 0}), near_pose = pose(0, 0, 0.4, 0, {1, 0, 0});
  for (const Scene& scene :
       {stillScene({far, near}, {far_pose, near_pose}), stillScene({near, far}, {near_pose, far_pose})}) {
    const RenderedImage image = render(scene);
    EXPECT_NEAR(image.depth(240, 320), 0.4, 1e-6);
    EXPECT_NEAR(image.depth(100, 320), 0.8, 1e-6);
    EXPECT_GT(image.color(240, 320)[0], image.color(100, 320)[0]);
  }
}

TEST(Renderer, EdgesOfTheImageLieWhereTheVerticesProjectTo) {
  // A black convex body on a bright wall: beyond 0.5 px from the outline of the projected vertices every
  // pixel is pure.
  const Eigen::Isometry3d T = pose(0.013, -0.021, 0.5, 140.0, {0.9, 0.2, 0.35});
  const Scene scene = stillScene({sponge(0.0f), {rectangleMesh(2.0, 2.0), uniformTexture(1.0f), 0.1}},
                                 {T, pose(0, 0, 1.0, 0, {1, 0, 0})});
  const RenderedImage image = render(scene);
  std::vector<cv::Point2f> projected, outline;
  const Points vertices = scene.state(0.0).vertices[0];
  for (Eigen::Index i = 0; i < vertices.rows(); ++i) {
    const Eigen::Vector2d pixel = kCamera.project(vertices.row(i).transpose());
    projected.emplace_back(static_cast<float>(pixel.x()), static_cast<float>(pixel.y()));
  }
  cv::convexHull(projected, outline);
  int mixed = 0;
  for (int v = 0; v < kCamera.height; ++v) {
    for (int u = 0; u < kCamera.width; ++u) {
      const double inside =
          cv::pointPolygonTest(outline, cv::Point2f(static_cast<float>(u), static_cast<float>(v)), true);
      const int level = image.color(v, u)[0];
      if (std::abs(inside) > 0.5) {
        EXPECT_EQ(level, inside > 0.0 ? 0 : image.color(0, 0)[0]) << u << ", " << v;
      }
      mixed += level != 0 && level != image.color(0, 0)[0];
    }
  }
  EXPECT_GT(mixed, 200);
}

/// Where a body's triangles lie on the image, kFine by kFine samples a pixel.
constexpr int kFine = 8;
cv::Mat1b fineMask(const Points& vertices, const Triangles& triangles) {
  cv::Mat1b mask = cv::Mat1b::zeros(kFine * kCamera.height, kFine * kCamera.width);
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    std::vector<cv::Point> corners;
    for (const int i : triangles.row(f)) {
      const Eigen::Vector2d pixel = kCamera.project(vertices.row(i).transpose());
      const Eigen::Vector2d fine = (pixel.array() + 0.5) * kFine - 0.5;
      corners.emplace_back(cvRound(fine.x()), cvRound(fine.y()));
    }
    cv::fillConvexPoly(mask, corners, 255);
  }
  return mask;
}

TEST(Renderer, EdgesOfTheDollLieWhereItsTrianglesProjectTo) {
  // More than half a pixel, and one sample of the mask, inside or outside of the outline every pixel is pure.
  const Eigen::Isometry3d T = pose(0.01, -0.02, 0.45, 205.0, {0.3, 0.9, 0.1});
  const Body doll = shippedBody("doll");
  const Scene scene = stillScene(
      {{doll.rest, uniformTexture(0.0f), 5e-3}, {rectangleMesh(2.0, 2.0), uniformTexture(1.0f), 0.1}},
      {T, pose(0, 0, 1.0, 0, {1, 0, 0})});
  const RenderedImage image = render(scene);
  const int wall = image.color(0, 0)[0];
  const cv::Mat1b mask = fineMask(scene.state(0.0).vertices[0], doll.rest.triangles);
  const cv::Mat disc = cv::getStructuringElement(cv::MORPH_ELLIPSE, {kFine + 3, kFine + 3});
  cv::Mat1b inside, outside;
  cv::erode(mask, inside, disc);
  cv::dilate(mask, outside, disc);
  int mixed = 0, covered = 0;
  for (int v = 0; v < kCamera.height; ++v) {
    for (int u = 0; u < kCamera.width; ++u) {
      const int level = image.color(v, u)[0];
      const cv::Point middle(kFine * u + kFine / 2, kFine * v + kFine / 2);
      if (inside(middle)) {
        EXPECT_EQ(level, 0) << u << ", " << v;
      } else if (!outside(middle)) {
        EXPECT_EQ(level, wall) << u << ", " << v;
      }
      covered += inside(middle) != 0;
      mixed += level != 0 && level != wall;
    }
  }
  EXPECT_GT(covered, 15000);
  EXPECT_GT(mixed, 400);
}

TEST(Renderer, VisibilityOfAConvexBodyIsThatOfItsFaces) {
  for (const double degrees : {0.0, 37.0, 140.0, 200.0, 290.0}) {
    const Eigen::Isometry3d T = pose(0.01, 0.02, 0.45, degrees, {0.8, 0.3, -0.5});
    const Scene scene = stillScene({sponge()}, {T});
    const RenderedImage image = render(scene);
    const Eigen::Vector3d eye = T.inverse().translation();
    const Eigen::Vector3d half(0.1, 0.05, 0.02);
    const Points& rest = scene.actors[0].rest.vertices;
    for (Eigen::Index i = 0; i < rest.rows(); ++i) {
      bool visible = false;
      for (int k = 0; k < 3; ++k) {
        const bool on_face = std::abs(std::abs(rest(i, k)) - half[k]) < 1e-9;
        visible = visible || (on_face && eye[k] * (rest(i, k) > 0.0 ? 1.0 : -1.0) > half[k]);
      }
      EXPECT_EQ(image.visibility[static_cast<std::size_t>(i)], visible ? 1.0f : 0.0f)
          << "vertex " << i << " at " << degrees;
    }
  }
}

TEST(Renderer, WhatIsBehindSomethingOrOutsideTheImageIsHidden) {
  const Eigen::Isometry3d T = pose(0, 0, 0.5, 0, {1, 0, 0});
  const Actor screen{rectangleMesh(0.2, 0.2), uniformTexture(0.5f)};
  const RenderedImage covered = render(stillScene({sponge(), screen}, {T, pose(0, 0, 0.3, 0, {1, 0, 0})}));
  const RenderedImage outside = render(stillScene({sponge()}, {pose(2.0, 0, 0.5, 0, {1, 0, 0})}));
  for (std::size_t i = 0; i < covered.visibility.size(); ++i) {
    EXPECT_EQ(covered.visibility[i], 0.0f);
    EXPECT_EQ(outside.visibility[i], 0.0f);
  }
}

TEST(Renderer, DoesNotDependOnTheNumberOfThreads) {
  const int threads = cv::getNumThreads();
  for (const std::string name : {"bend", "doll_shake"}) {
    const Scene scene = makeScene(name, shippedBody(objectOf(name)), 3);
    const auto capture = [&](int number) {
      cv::setNumThreads(number);
      return VirtualCamera(scene, kCamera, NoiseOptions(), 5).capture(40, 40.0 / 30.0);
    };
    const Capture one = capture(1), three = capture(3);
    EXPECT_EQ(cv::norm(one.color, three.color, cv::NORM_INF), 0.0) << name;
    EXPECT_EQ(cv::norm(one.depth_mm, three.depth_mm, cv::NORM_INF), 0.0) << name;
    EXPECT_EQ(one.truth.vertices, three.truth.vertices) << name;
    EXPECT_EQ(one.truth.confidence, three.truth.confidence) << name;
  }
  cv::setNumThreads(threads);
}

}  // namespace
}  // namespace softbody::virtual_camera
