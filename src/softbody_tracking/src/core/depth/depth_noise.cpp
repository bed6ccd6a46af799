#include "depth/depth_noise.h"

#include <algorithm>
#include <cmath>

#include "depth/depth_associations.h"

namespace softbody {
namespace {

constexpr int kApart = 4;  // [px] at least; a stereo camera errs alike in pixels side by side
constexpr double kMedianOfNormal = 0.6745;  // of its absolute value, in standard deviations
constexpr double kMostRemembered = 3000.0;  // bends, of about two frames of 1500 blocks

bool agree(const DepthBlock& a, const DepthBlock& b, const DepthBlock& c) {
  constexpr auto kAgrees = DepthBlock::Kind::kAgrees;
  return a.kind == kAgrees && b.kind == kAgrees && c.kind == kAgrees;
}

/// Of blocks and those a step before and after them, on one piece; times the depth, as a block's width is.
void addBends(const SurfaceSamples& surface, const std::vector<DepthBlock>& blocks, const cv::Point& step,
              std::vector<double>* bends) {
  const cv::Mat1i& grid = surface.grid;
  for (int row = step.y; row < grid.rows - step.y; ++row) {
    for (int column = step.x; column < grid.cols - step.x; ++column) {
      const int before = grid(row - step.y, column - step.x), middle = grid(row, column),
                after = grid(row + step.y, column + step.x);
      if (before < 0 || middle < 0 || after < 0) continue;
      const DepthBlock &a = blocks[before], &b = blocks[middle], &c = blocks[after];
      const std::uint32_t body = surface.samples[middle].body;
      if (!agree(a, b, c) || surface.samples[before].body != body || surface.samples[after].body != body)
        continue;
      bends->push_back(b.predicted * std::abs(a.difference - 2.0 * b.difference + c.difference));
    }
  }
}

}  // namespace

NoiseSample noiseOf(const SurfaceSamples& surface, const std::vector<DepthBlock>& blocks, double focal_px,
                    std::vector<double>* memory) {
  const int apart = (kApart + surface.block_px - 1) / surface.block_px;
  std::vector<double>& bends = *memory;
  bends.clear();
  addBends(surface, blocks, {apart, 0}, &bends);
  addBends(surface, blocks, {0, apart}, &bends);
  if (bends.empty()) return {};
  const auto median = bends.begin() + static_cast<std::ptrdiff_t>(bends.size() / 2);
  std::nth_element(bends.begin(), median, bends.end());
  const double sigma = *median / (kMedianOfNormal * std::sqrt(6.0));  // times the depth
  return {sigma * surface.block_px / focal_px, bends.size()};
}

void DepthNoise::learn(const NoiseSample& sample) {
  if (sample.bends == 0) return;
  const double bends = bends_ + static_cast<double>(sample.bends);
  variance_ += (sample.density * sample.density - variance_) * static_cast<double>(sample.bends) / bends;
  bends_ = std::min(bends, kMostRemembered);
}

double DepthNoise::over(double side_m) const { return std::sqrt(variance_) / side_m; }

}  // namespace softbody
