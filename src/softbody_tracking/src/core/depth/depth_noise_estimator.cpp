#include "depth/depth_noise_estimator.h"

#include <algorithm>
#include <cmath>

#include "depth/depth_associations.h"
#include "prediction/memory.h"
#include "softbody_common/statistics/median.h"

namespace softbody {
namespace {

constexpr int kMinSpacing_px =
    4;  // [px] between blocks: a stereo camera gives neighbouring pixels equal errors

bool agree(const DepthBlock& a, const DepthBlock& b, const DepthBlock& c) {
  constexpr auto kAgrees = DepthBlock::Kind::kAgrees;
  return a.kind == kAgrees && b.kind == kAgrees && c.kind == kAgrees;
}

/// Appends |second difference| * depth for each block whose neighbours at -step and +step lie on the same
/// piece. The depth makes up for the width of a block on the surface, which grows with it.
void addSecondDifferences(const SurfaceSamples& surface, const std::vector<DepthBlock>& blocks,
                          const cv::Point& step, std::vector<double>* differences) {
  const cv::Mat1i& grid = surface.grid;
  for (int row = step.y; row < grid.rows - step.y; ++row) {
    for (int column = step.x; column < grid.cols - step.x; ++column) {
      const int before = grid(row - step.y, column - step.x), middle = grid(row, column),
                after = grid(row + step.y, column + step.x);
      if (before < 0 || middle < 0 || after < 0) continue;
      const DepthBlock &a = blocks[before], &b = blocks[middle], &c = blocks[after];
      const std::uint32_t piece = surface.samples[middle].piece;
      if (!agree(a, b, c) || surface.samples[before].piece != piece || surface.samples[after].piece != piece)
        continue;
      differences->push_back(b.predicted * std::abs(a.difference - 2.0 * b.difference + c.difference));
    }
  }
}

}  // namespace

DepthNoiseSample sampleDepthNoise(const SurfaceSamples& surface, const std::vector<DepthBlock>& blocks,
                                  double focal_px) {
  const int spacing = (kMinSpacing_px + surface.block_px - 1) / surface.block_px;  // in blocks
  std::vector<double> differences;
  differences.reserve(2 * blocks.size());
  addSecondDifferences(surface, blocks, {spacing, 0}, &differences);
  addSecondDifferences(surface, blocks, {0, spacing}, &differences);
  // Of white noise, a second difference has six times the variance. The median resists outliers.
  const double sigma = median(&differences) / (kMedianPerSigma * std::sqrt(6.0));  // times the depth
  return {sigma * surface.block_px / focal_px, differences.size()};
}

void DepthNoiseEstimator::update(const DepthNoiseSample& sample, double elapsed_s) {
  const double remembered = std::max(kFewest, count_ * (1.0 - newestShare(elapsed_s, kErrorMemory_s)));
  count_ = remembered + static_cast<double>(sample.count);
  variance_ += (sample.density * sample.density - variance_) * static_cast<double>(sample.count) / count_;
}

double DepthNoiseEstimator::patchStdDev(double side_m) const { return std::sqrt(variance_) / side_m; }

}  // namespace softbody
