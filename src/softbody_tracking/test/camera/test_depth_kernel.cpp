#include <gtest/gtest.h>

#include <hwy/highway.h>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include "camera/depth_kernel.h"

namespace softbody {
namespace {

constexpr double kRatio = 0.02;

DepthLimits limitsOf(float unit_m, double ratio) { return {unit_m, 0.1f, 5.0f, static_cast<float>(ratio)}; }

cv::Mat1f removeFlyingPixels(const cv::Mat1f& depth, double ratio) {
  cv::Mat1f result;
  DepthCleaner().clean(depth, limitsOf(1.0f, ratio), &result);
  cv::patchNaNs(result, 0.0);
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

/// The definition, a pixel at a time.
float cleanAt(const cv::Mat1f& metres, const cv::Point& pixel, float ratio) {
  const auto at = [&](int u, int v) {
    const cv::Point place = pixel + cv::Point(u, v);
    return cv::Rect({}, metres.size()).contains(place) ? metres(place) : 0.0f;
  };
  const float z = at(0, 0), none = std::numeric_limits<float>::quiet_NaN();
  if (!(z > 0.0f) || ratio == 0.0f) return z > 0.0f ? z : none;
  int near = 0;
  bool step = false;
  for (const cv::Point& way : {cv::Point(1, 0), cv::Point(0, 1), cv::Point(1, 1), cv::Point(1, -1)}) {
    const bool diagonal = way.x != 0 && way.y != 0;
    const float reach = diagonal ? static_cast<float>(M_SQRT2) * (ratio * z) : ratio * z;
    const float a = at(way.x, way.y), b = at(-way.x, -way.y);
    near += static_cast<int>(std::abs(a - z) <= reach) + static_cast<int>(std::abs(b - z) <= reach);
    step |= std::min(a, b) > 0.0f && std::min(a, b) < z - reach && std::max(a, b) > z + reach;
  }
  return near >= 2 && !step ? z : none;
}

/// Surfaces with gaps, edges and noise, in millimetres or in metres with all that a driver may send.
cv::Mat randomRaw(bool is_float, const cv::Size& size, std::mt19937* random) {
  std::uniform_int_distribution<int> kind(0, 9), surface(0, 2);
  std::normal_distribution<float> noise(0.0f, 0.004f);
  const float odd[] = {std::numeric_limits<float>::quiet_NaN(),
                       std::numeric_limits<float>::infinity(),
                       -1.0f,
                       0.0f,
                       7.0f,
                       0.05f};
  cv::Mat1f raw(size);
  float z = 0.6f;
  for (float& pixel : raw) {
    if (kind(*random) == 0) z = 0.5f + 0.013f * static_cast<float>(surface(*random));
    pixel = kind(*random) == 0 ? odd[kind(*random) % 6] : z + noise(*random);
  }
  if (is_float) return raw;
  cv::Mat millimetres;
  cv::Mat(cv::max(cv::min(raw, 60.0f), 0.0f)).convertTo(millimetres, CV_16U, 1000.0);
  return millimetres;
}

class DepthKernel : public testing::TestWithParam<unsigned> {
 protected:
  ~DepthKernel() override { hwy::SetSupportedTargetsForTest(0); }
  std::mt19937 random_{GetParam()};
};
INSTANTIATE_TEST_SUITE_P(Seeds, DepthKernel, testing::Range(0u, 60u));

/// Of every width, with every vector, from images and into memory that are parts of larger ones.
TEST_P(DepthKernel, EachPixelIsAsTheDefinitionSaysToTheBit) {
  const bool is_float = GetParam() % 2 == 0, filters = GetParam() % 3 != 0;
  const cv::Size size(1 + static_cast<int>(GetParam()), 1 + static_cast<int>(random_() % 9));
  const cv::Rect part({2, 1}, size);
  const cv::Mat raw = randomRaw(is_float, size + cv::Size(5, 3), &random_)(part);
  const DepthLimits limits = limitsOf(is_float ? 1.0f : 0.001f, filters ? kRatio : 0.0);
  cv::Mat1f metres(size);
  for (int v = 0; v < size.height; ++v) {
    for (int u = 0; u < size.width; ++u) {
      const float z = limits.unit_m * (is_float ? raw.at<float>(v, u) : raw.at<std::uint16_t>(v, u));
      metres(v, u) = z >= limits.min_m && z <= limits.max_m ? z : 0.0f;
    }
  }
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    cv::Mat1f around(size + cv::Size(5, 3), -7.0f), clean = around(part);
    DepthCleaner().clean(raw, limits, &clean);
    ASSERT_EQ(clean.data, around(part).data);
    for (int v = 0; v < around.rows; ++v) {
      for (int u = 0; u < around.cols; ++u) {
        const float expected =
            part.contains({u, v}) ? cleanAt(metres, cv::Point(u, v) - part.tl(), limits.jump_ratio) : -7.0f;
        ASSERT_TRUE(std::isnan(expected) ? std::isnan(around(v, u)) : around(v, u) == expected)
            << hwy::TargetName(target) << ": " << u << " " << v;
      }
    }
  }
}

}  // namespace
}  // namespace softbody
