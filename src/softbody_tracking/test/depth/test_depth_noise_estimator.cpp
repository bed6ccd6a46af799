#include "depth/depth_noise_estimator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "depth/depth_associations.h"

namespace softbody {
namespace {

constexpr double kFocal = 600.0, kDepth = 0.5;  // [px], [m]
constexpr double kFrameInterval_s = 1.0 / 30.0;

/// Blocks of a surface that faces the camera. @param difference of a block, by column and row [m].
DepthNoiseSample sampleOf(const cv::Size& grid, int block_px,
                          const std::function<double(int, int)>& difference) {
  SurfaceSamples surface;
  surface.block_px = block_px;
  surface.grid.create(grid);
  std::vector<DepthBlock> blocks;
  for (int row = 0; row < grid.height; ++row) {
    for (int column = 0; column < grid.width; ++column) {
      surface.grid(row, column) = static_cast<int>(blocks.size());
      surface.samples.emplace_back();
      DepthBlock& block = blocks.emplace_back();
      block.kind = DepthBlock::Kind::kAgrees;
      block.predicted = kDepth;
      block.difference = difference(column, row);
    }
  }
  return sampleDepthNoise(surface, blocks, kFocal);
}

/// @param sigma_m standard deviation of a block's mean.
DepthNoiseSample noisy(const cv::Size& grid, double sigma_m, int block_px = 5) {
  std::mt19937 random(3);
  std::normal_distribution<double> gauss(0.0, sigma_m);
  return sampleOf(grid, block_px, [&](int, int) { return gauss(random); });
}

double width(int block_px) { return block_px * kDepth / kFocal; }

TEST(SampleDepthNoise, IsTheSigmaOfABlockTimesItsWidth) {
  for (const int block_px : {1, 3, 5, 20}) {
    const double sigma = 0.004 / block_px;  // of independent pixels' mean
    const DepthNoiseSample sample = noisy({60, 60}, sigma, block_px);
    EXPECT_NEAR(sample.density, sigma * width(block_px), 0.06 * sigma * width(block_px)) << block_px;
  }
}

TEST(SampleDepthNoise, CountsRowsAndColumnsOfAThinBody) {
  const DepthNoiseSample lying = noisy({300, 3}, 0.002), upright = noisy({3, 300}, 0.002);
  EXPECT_EQ(lying.count, upright.count);
  EXPECT_GT(upright.count, 500u);
  for (const DepthNoiseSample& sample : {lying, upright})
    EXPECT_NEAR(sample.density, 0.002 * width(5), 0.1 * 0.002 * width(5));
}

TEST(SampleDepthNoise, IgnoresASlope) {
  const DepthNoiseSample sample =
      sampleOf({40, 30}, 5, [](int column, int row) { return 0.002 * column - 0.001 * row; });
  EXPECT_GT(sample.count, 1000u);
  EXPECT_LT(sample.density, 1e-12);
}

/// Pixels in one matching window of a stereo camera have equal errors.
TEST(SampleDepthNoise, ComparesBlocksWithIndependentErrors) {
  for (const int block_px : {1, 2}) {
    const int alike = 4 / block_px;
    std::mt19937 random(3);
    std::normal_distribution<double> gauss(0.0, 0.002);
    cv::Mat1d error(60, 60);
    for (double& value : error) value = gauss(random);
    const DepthNoiseSample sample =
        sampleOf({60, 60}, block_px, [&](int column, int row) { return error(row / alike, column / alike); });
    EXPECT_NEAR(sample.density, 0.002 * width(block_px), 0.12 * 0.002 * width(block_px)) << block_px;
  }
}

TEST(DepthNoiseEstimator, AWiderPatchHasLessNoise) {
  DepthNoiseEstimator noise;
  EXPECT_EQ(noise.patchStdDev(0.03), 0.0) << "unknown";
  for (int frame = 0; frame < 100; ++frame) noise.update({6e-6, 2000}, kFrameInterval_s);
  EXPECT_NEAR(noise.patchStdDev(0.03), 0.2e-3, 1e-6);
  EXPECT_NEAR(noise.patchStdDev(0.06), 0.1e-3, 1e-6);
}

TEST(DepthNoiseEstimator, OneFrameThatShowsMuchIsEnough) {
  DepthNoiseEstimator noise;
  noise.update({6e-6, 2000}, kFrameInterval_s);
  EXPECT_NEAR(noise.patchStdDev(1.0), 6e-6, 0.1e-6);
}

TEST(DepthNoiseEstimator, FollowsAChangeWithinEightFrames) {
  DepthNoiseEstimator noise;
  for (int frame = 0; frame < 100; ++frame) noise.update({2e-6, 2000}, kFrameInterval_s);
  for (int frame = 0; frame < 8; ++frame) noise.update({6e-6, 2000}, kFrameInterval_s);
  EXPECT_NEAR(noise.patchStdDev(1.0), 6e-6, 0.2e-6);
}

/// A hand covers most of the body.
TEST(DepthNoiseEstimator, AFrameThatShowsLittleChangesLittle) {
  DepthNoiseEstimator noise;
  for (int frame = 0; frame < 10; ++frame) noise.update({6e-6, 2000}, kFrameInterval_s);
  const double before = noise.patchStdDev(1.0);
  noise.update({}, kFrameInterval_s);
  EXPECT_EQ(noise.patchStdDev(1.0), before);
  noise.update({3e-6, 31}, kFrameInterval_s);
  noise.update({9e-6, 29}, kFrameInterval_s);
  EXPECT_NEAR(noise.patchStdDev(1.0), before, 0.03 * before);
}

/// A body that never shows much.
TEST(DepthNoiseEstimator, ManyFramesThatShowLittleAreEnough) {
  DepthNoiseEstimator noise;
  noise.update({6e-6, 5}, kFrameInterval_s);
  EXPECT_LT(noise.patchStdDev(1.0), 3e-6) << "five second differences are few";
  for (int frame = 0; frame < 300; ++frame) noise.update({6e-6, 5}, kFrameInterval_s);
  EXPECT_NEAR(noise.patchStdDev(1.0), 6e-6, 0.1e-6);
}

TEST(WeighByNoise, NeverLeavesAFastBodyWithoutDepth) {
  for (const double relative_noise : {0.05, 0.5, 5.0}) {
    DepthAssociations depth;
    depth.associations.resize(1);
    downweightByNoise(relative_noise, &depth);
    EXPECT_DOUBLE_EQ(depth.associations[0].weight, 1.0 / 6.0);
  }
}

}  // namespace
}  // namespace softbody
