#include <gtest/gtest.h>

#include <hwy/highway.h>
#include <cmath>
#include <cstring>
#include <random>

#include "patches/patch_kernel.h"

namespace softbody {
namespace {

constexpr int kHalf = kPatchSide / 2;

struct Case {
  cv::Mat1b image;
  RowPairs pairs;
  cv::Point2f center;
  Eigen::Matrix2f warp;
  PatchTemplate pattern;
};

RowPairs pairsOf(const cv::Mat1b& image) {
  RowPairs pairs(image.rows - 1, image.cols);
  for (int v = 0; v < pairs.rows; ++v)
    for (int u = 0; u < pairs.cols; ++u) pairs(v, u) = {image(v, u), image(v + 1, u)};
  return pairs;
}

/// A random image and a grid that just fits into it. The image's memory ends with its last row.
Case randomCase(std::mt19937* random) {
  std::uniform_int_distribution<int> size(40, 70), gray(0, 255);
  std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
  Case made{cv::Mat1b(size(*random), size(*random)), {}, {}, {}, {}};
  for (uchar& pixel : made.image) pixel = static_cast<uchar>(gray(*random));
  made.pairs = pairsOf(made.image);
  made.warp << 1.0f + 0.3f * uniform(*random), 0.3f * uniform(*random), 0.3f * uniform(*random),
      1.0f + 0.3f * uniform(*random);
  const auto place = [&](int pixels, int row) {
    const float reach = kHalf * (std::abs(made.warp(row, 0)) + std::abs(made.warp(row, 1)));
    const float last = static_cast<float>(pixels - 1) - reach;
    return std::clamp(0.5f * (reach + last) + 0.6f * uniform(*random) * (last - reach), reach, last);
  };
  made.center = {place(made.image.cols, 0), place(made.image.rows, 1)};
  for (PatchSamples* samples : {&made.pattern.values, &made.pattern.dx, &made.pattern.dy}) {
    samples->values.fill(0.0f);
    auto values = Eigen::Map<Eigen::ArrayXf>(samples->values.data(), kPatchSize);
    for (float& value : values) value = uniform(*random);
    values -= values.mean();
  }
  return made;
}

double bilinear(const cv::Mat1b& image, double u, double v) {
  const int u0 = std::min(static_cast<int>(u), image.cols - 2),
            v0 = std::min(static_cast<int>(v), image.rows - 2);
  const double a = u - u0, b = v - v0;
  return (1 - b) * ((1 - a) * image(v0, u0) + a * image(v0, u0 + 1)) +
         b * ((1 - a) * image(v0 + 1, u0) + a * image(v0 + 1, u0 + 1));
}

double sampleAt(const Case& c, int i) {
  const Eigen::Vector2d place(i % kPatchSide - kHalf, i / kPatchSide - kHalf);
  const Eigen::Vector2d offset = c.warp.cast<double>() * place;
  return bilinear(c.image, c.center.x + offset.x(), c.center.y + offset.y());
}

class PatchKernel : public testing::TestWithParam<unsigned> {
 protected:
  ~PatchKernel() override { hwy::SetSupportedTargetsForTest(0); }
  std::mt19937 random_{GetParam()};
};
INSTANTIATE_TEST_SUITE_P(Seeds, PatchKernel, testing::Range(0u, 50u));

TEST_P(PatchKernel, SamplesBilinearlyOnTheWarpedGrid) {
  const Case c = randomCase(&random_);
  PatchSamples samples;
  samplePatch(c.pairs, c.center, c.warp, &samples);
  for (int i = 0; i < kPatchSize; ++i) EXPECT_NEAR(samples.values[i], sampleAt(c, i), 0.02) << i;
  for (int i = kPatchSize; i < PatchSamples::kPadded; ++i) EXPECT_EQ(samples.values[i], 0.0f) << i;
}

TEST_P(PatchKernel, ComparesWithoutTheMean) {
  const Case c = randomCase(&random_);
  PatchSamples samples;
  samplePatch(c.pairs, c.center, c.warp, &samples);
  Eigen::Array<double, kPatchSize, 1> centered;
  for (int i = 0; i < kPatchSize; ++i) centered[i] = samples.values[i];
  centered -= centered.mean();
  const auto dot = [&](const PatchSamples& other) {
    double sum = 0.0;
    for (int i = 0; i < kPatchSize; ++i) sum += centered[i] * other.values[i];
    return sum;
  };
  const PatchSums sums = comparePatch(c.pairs, c.center, c.warp, c.pattern);
  EXPECT_NEAR(sums.spread, centered.matrix().norm(), 1e-3);
  EXPECT_NEAR(sums.product, dot(c.pattern.values), 1e-2);
  EXPECT_NEAR(sums.along_x, dot(c.pattern.dx), 1e-2);
  EXPECT_NEAR(sums.along_y, dot(c.pattern.dy), 1e-2);
}

TEST_P(PatchKernel, VectorsOfAnyWidthGiveTheSameBits) {
  const Case c = randomCase(&random_);
  PatchSamples first;
  PatchSums first_sums;
  bool is_first = true;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    PatchSamples samples;
    samplePatch(c.pairs, c.center, c.warp, &samples);
    const PatchSums sums = comparePatch(c.pairs, c.center, c.warp, c.pattern);
    if (is_first) first = samples, first_sums = sums;
    is_first = false;
    EXPECT_EQ(samples.values, first.values) << hwy::TargetName(target);
    EXPECT_EQ(std::memcmp(&sums, &first_sums, sizeof(sums)), 0) << hwy::TargetName(target);
  }
  EXPECT_FALSE(is_first);
}

}  // namespace
}  // namespace softbody
