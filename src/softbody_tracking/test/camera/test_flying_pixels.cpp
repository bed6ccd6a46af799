#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "camera/flying_pixels.h"

namespace softbody {
namespace {

constexpr double kRatio = 0.02;

cv::Mat1f removeFlyingPixels(const cv::Mat1f& depth, double ratio) {
  cv::Mat1f result;
  FlyingPixelFilter(ratio).apply(depth, &result);
  return result;
}

int countOf(const cv::Mat1f& depth) { return cv::countNonZero(depth); }

cv::Mat1f plane(double f, double slant_rad, double direction_rad) {
  // z of n . p = n . (0, 0, 0.6)
  const double nx = std::sin(slant_rad) * std::cos(direction_rad),
               ny = std::sin(slant_rad) * std::sin(direction_rad);
  cv::Mat1f depth(120, 160);
  for (int v = 0; v < depth.rows; ++v) {
    for (int u = 0; u < depth.cols; ++u) {
      const double along = nx * (u - 80) / f + ny * (v - 60) / f + std::cos(slant_rad);
      const double z = along > 0.0 ? 0.6 * std::cos(slant_rad) / along : 0.0;
      depth(v, u) = z < 5.0 ? static_cast<float>(z) : 0.0f;
    }
  }
  return depth;
}

TEST(FlyingPixels, SlantedPlanesStay) {
  for (int degrees = 0; degrees <= 75; degrees += 15) {
    for (double direction = 0.0; direction < 6.28; direction += 0.4) {
      const cv::Mat1f depth = plane(275.0, degrees * CV_PI / 180.0, direction);
      // The step from pixel to pixel is tan(slant) / f of z near the optical axis.
      const cv::Rect middle(70, 50, 20, 20);
      const cv::Mat1f kept = removeFlyingPixels(depth, kRatio)(middle);
      EXPECT_EQ(countOf(kept), countOf(depth(middle))) << degrees << " degrees towards " << direction;
    }
  }
}

TEST(FlyingPixels, NoiseOnASurfaceIsNotAnEdge) {
  std::mt19937 random(3);
  std::normal_distribution<float> noise(0.0f, 0.002f);
  cv::Mat1f depth = plane(275.0, 0.8, 0.5);
  depth.forEach([&](float& z, const int*) { z = z > 0.0f ? z + noise(random) : z; });
  EXPECT_GT(countOf(removeFlyingPixels(depth, kRatio)), 0.999 * countOf(depth));
}

TEST(FlyingPixels, WiresOfOnePixelStayInEveryDirection) {
  for (const cv::Point step : {cv::Point(1, 0), cv::Point(0, 1), cv::Point(1, 1), cv::Point(1, -1)}) {
    cv::Mat1f depth(41, 41, 1.0f);
    const cv::Point middle(20, 20);
    for (int k = -15; k <= 15; ++k) depth(middle + k * step) = 0.5f;
    const cv::Mat1f kept = removeFlyingPixels(depth, kRatio);
    for (int k = -14; k <= 14; ++k) EXPECT_EQ(kept(middle + k * step), 0.5f);
  }
}

TEST(FlyingPixels, RampsAcrossAnEdgeGoAndBothSurfacesStay) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> angle(0.0, 6.28), between(0.1, 0.9);
  for (int trial = 0; trial < 50; ++trial) {
    // A straight edge in any direction, with one or two rows of pixels in between.
    const double a = angle(random), width = trial % 2 == 0 ? 1.0 : 2.0, share = between(random);
    cv::Mat1f depth(60, 60);
    cv::Mat1b flying(60, 60, uchar(0));
    for (int v = 0; v < 60; ++v) {
      for (int u = 0; u < 60; ++u) {
        const double across = (u - 30) * std::cos(a) + (v - 30) * std::sin(a);
        const bool in_between = across >= 0.0 && across < width;
        const double z = in_between     ? 0.5 + 0.5 * (width == 1.0 ? share : 0.1 + 0.4 * across)
                         : across < 0.0 ? 0.5
                                        : 1.0;
        depth(v, u) = static_cast<float>(z);
        flying(v, u) = in_between ? 255 : 0;
      }
    }
    const cv::Mat1f kept = removeFlyingPixels(depth, kRatio);
    cv::Mat1f flying_left = kept.clone(), surface_left = kept.clone(), surface = depth.clone();
    flying_left.setTo(0.0f, flying == 0);
    surface_left.setTo(0.0f, flying);
    surface.setTo(0.0f, flying);
    EXPECT_LT(countOf(flying_left), 0.1 * cv::countNonZero(flying) + 2)
        << "angle " << a << " width " << width;
    EXPECT_GE(countOf(surface_left), countOf(surface) - 4) << "angle " << a;
  }
}

TEST(FlyingPixels, StrayPixelsGoAndNothingIsInvented) {
  cv::Mat1f depth = cv::Mat1f::zeros(20, 20);
  depth(5, 5) = 0.7f;
  depth(12, 12) = 0.7f;
  depth(12, 13) = 0.9f;
  EXPECT_EQ(countOf(removeFlyingPixels(depth, kRatio)), 0);
  cv::Mat1f random(50, 70);
  cv::randu(random, 0.3, 2.0);
  const cv::Mat1f kept = removeFlyingPixels(random, kRatio);
  for (int v = 0; v < 50; ++v) {
    for (int u = 0; u < 70; ++u) EXPECT_TRUE(kept(v, u) == 0.0f || kept(v, u) == random(v, u));
  }
}

TEST(FlyingPixels, ObjectsKeepTheirBoundaryToTheBackground) {
  cv::Mat1f depth(50, 50, 1.0f);
  depth(cv::Rect(15, 15, 20, 20)) = 0.5f;
  EXPECT_EQ(cv::norm(removeFlyingPixels(depth, kRatio), depth, cv::NORM_INF), 0.0);
}

}  // namespace
}  // namespace softbody
