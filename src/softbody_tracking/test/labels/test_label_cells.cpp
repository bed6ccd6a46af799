#include "labels/label_cells.h"

#include <gtest/gtest.h>

#include <random>

namespace softbody {
namespace {

/// Samples in some cells of a grid, each at another depth.
SurfaceSamples someSamples(const cv::Size& grid, int block_px, double share, std::mt19937* random) {
  std::bernoulli_distribution has_sample(share);
  SurfaceSamples samples;
  samples.block_px = block_px;
  samples.grid = cv::Mat1i(grid, -1);
  for (int& index : samples.grid) {
    if (!has_sample(*random)) continue;
    index = static_cast<int>(samples.samples.size());
    SurfaceSample sample;
    sample.position = Eigen::Vector3d(0.0, 0.0, 0.5 + 0.001 * index);
    samples.samples.push_back(sample);
  }
  return samples;
}

TEST(LabelCells, TakeTheNearestSample) {
  std::mt19937 random(4);
  for (const int block_px : {1, 3, 8}) {
    const SurfaceSamples samples = someSamples({9, 7}, block_px, 0.15, &random);
    const LabelCells cells = makeCells({40, 30, 9 * block_px, 7 * block_px}, samples, 10);
    const cv::Point margin = (cv::Point(40, 30) - cells.origin) / block_px;
    ASSERT_EQ(cells.grid, samples.grid.size() + cv::Size(margin) * 2);
    EXPECT_GE(margin.x * block_px, 10) << "at least the margin";
    const auto stepsTo = [&](const cv::Point& from, const cv::Point& sample) {
      return std::abs(from.x - sample.x - margin.x) + std::abs(from.y - sample.y - margin.y);
    };
    for (cv::Point place(0, 0); place.y < cells.grid.height; ++place.y) {
      for (place.x = 0; place.x < cells.grid.width; ++place.x) {
        int nearest = 1000, own = 1000;
        for (cv::Point at(0, 0); at.y < samples.grid.rows; ++at.y) {
          for (at.x = 0; at.x < samples.grid.cols; ++at.x) {
            if (samples.grid(at) < 0) continue;
            nearest = std::min(nearest, stepsTo(place, at));
            if (samples.grid(at) == cells.at(place).sample) own = stepsTo(place, at);
          }
        }
        EXPECT_EQ(cells.at(place).distance, nearest) << place;
        EXPECT_EQ(own, nearest) << place;
        EXPECT_EQ(cells.at(place).onSurface(), nearest == 0) << place;
        EXPECT_FLOAT_EQ(cells.at(place).predicted, 0.5f + 0.001f * cells.at(place).sample);
      }
    }
  }
}

TEST(LabelCells, CoverTheSamplesBlocks) {
  std::mt19937 random(4);
  const SurfaceSamples samples = someSamples({9, 7}, 8, 1.0, &random);
  const LabelCells cells = makeCells({3, 5, 72, 56}, samples, 24);
  EXPECT_EQ(cells.origin, cv::Point(-21, -19)) << "partly outside of the image";
  EXPECT_EQ(cells.pixels({3, 3}), cv::Rect(3, 5, 8, 8));
  EXPECT_EQ(cells.at({3, 3}).sample, 0);
  EXPECT_TRUE(cells.contains(cv::Point(cells.grid) - cv::Point(1, 1)));
  EXPECT_FALSE(cells.contains(cv::Point(cells.grid)));
}

TEST(LabelCells, HaveNoSampleWithoutAny) {
  SurfaceSamples none;
  none.block_px = 4;
  none.grid = cv::Mat1i(2, 3, -1);
  for (const LabelCell& cell : makeCells({0, 0, 12, 8}, none, 8).cells) EXPECT_EQ(cell.sample, -1);
}

}  // namespace
}  // namespace softbody
