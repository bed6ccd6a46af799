#include "labels/region_colors.h"

#include <cmath>
#include <numeric>

#include "prediction/memory.h"

namespace softbody {
namespace {

// Distance [px] from the outline at which a pixel shows the body alone.
constexpr int kInside = 3;
// Every second pixel of every second row is enough for a histogram.
constexpr int kStep = 2;
// Pixels on each side, below which nothing is learned: a few pixels may show anything.
constexpr float kFewest = 100.0f;

/// Whether the body is rendered at a pixel and around it.
bool isInside(const cv::Mat1f& rendered, int u, int v) {
  return rendered(v, u) > 0.0f && rendered(v, u - kInside) > 0.0f && rendered(v, u + kInside) > 0.0f &&
         rendered(v - kInside, u) > 0.0f && rendered(v + kInside, u) > 0.0f;
}

}  // namespace

RegionColors::RegionColors() { reset(); }

void RegionColors::reset() {
  body_.clear();
  surroundings_.clear();
  log_odds_.assign(kBins, 0.0f);
}

void RegionColors::blend(const std::vector<float>& counts, double elapsed_s, std::vector<float>* densities) {
  const float sum = std::accumulate(counts.begin(), counts.end(), 0.0f);
  const auto rate = static_cast<float>(densities->empty() ? 1.0 : newestShare(elapsed_s, kMemory_s));
  densities->resize(kBins, 0.0f);
  for (std::size_t i = 0; i < counts.size(); ++i)
    (*densities)[i] += rate * (counts[i] / sum - (*densities)[i]);
}

void RegionColors::learn(const RgbdFrame& frame, const RasterImage& rendered, const Labels& labels,
                         double elapsed_s) {
  counts_of_body_.assign(kBins, 0.0f);
  counts_around_.assign(kBins, 0.0f);
  const cv::Rect region = labels.region & cv::Rect(kInside, kInside, frame.color.cols - 2 * kInside,
                                                   frame.color.rows - 2 * kInside);
  float on_body = 0.0f, around = 0.0f;
  for (int v = region.y; v < region.br().y; v += kStep) {
    for (int u = region.x; u < region.br().x; u += kStep) {
      const std::size_t color = bin(frame.color(v, u));
      const std::uint8_t label = labels.at({u, v});
      if (label == labels::kBody && isInside(rendered.depth, u, v)) {
        counts_of_body_[color] += 1.0f;
        on_body += 1.0f;
      } else if (label != labels::kBody && (label != labels::kUnknown || rendered.triangle(v, u) < 0)) {
        counts_around_[color] += 1.0f;
        around += 1.0f;
      }
    }
  }
  if (on_body < kFewest || around < kFewest) return;
  blend(counts_of_body_, elapsed_s, &body_);
  blend(counts_around_, elapsed_s, &surroundings_);
  for (std::size_t i = 0; i < log_odds_.size(); ++i)
    log_odds_[i] = std::log((body_[i] + kUnseen) / (surroundings_[i] + kUnseen));
}

cv::Mat1b RegionColors::mask(const cv::Mat3b& color, const cv::Rect& region) const {
  cv::Mat1b result(color.size(), 0);
  for (int v = region.y; v < region.br().y; ++v)
    for (int u = region.x; u < region.br().x; ++u) result(v, u) = belongs(color(v, u)) ? 255 : 0;
  return result;
}

}  // namespace softbody
