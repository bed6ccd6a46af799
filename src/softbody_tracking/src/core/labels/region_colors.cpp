#include "labels/region_colors.h"

#include <cmath>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "prediction/memory.h"

namespace softbody {
namespace {

// Distance [px] from the outline at which a pixel shows the body alone.
constexpr int kInside = 3;
// Standard deviation of the predicted outline, and of the blur of lens and debayering together [px].
constexpr double kBlur = 1.5;
// Every second pixel of every second row is enough for a histogram.
constexpr int kStep = 2;
// Pixels on each side, below which nothing is learned: a few pixels may show anything.
constexpr float kFewest = 100.0f;

/// Whether the body is rendered at a pixel and around it.
bool isInside(const cv::Mat1f& rendered, int u, int v) {
  return rendered(v, u) > 0.0f && rendered(v, u - kInside) > 0.0f && rendered(v, u + kInside) > 0.0f &&
         rendered(v - kInside, u) > 0.0f && rendered(v + kInside, u) > 0.0f;
}

/// Share of each pixel of a region that shows the body, for an outline that is known up to a blur.
cv::Mat1f silhouette(const cv::Mat1f& rendered, const cv::Rect& region) {
  const cv::Rect image(cv::Point(), rendered.size());
  const int margin = cvCeil(3.0 * kBlur);
  const cv::Rect around =
      cv::Rect(region.tl() - cv::Point(margin, margin), region.br() + cv::Point(margin, margin)) & image;
  cv::Mat1f share;
  cv::threshold(rendered(around), share, 0.0, 1.0, cv::THRESH_BINARY);
  cv::GaussianBlur(share, share, {}, kBlur, kBlur, cv::BORDER_REPLICATE);
  return share(region - around.tl());
}

/// @param counts in each bin. @param all their sum; 0: nothing is learned.
void blend(const std::vector<float>& counts, float all, float share, std::vector<float>* mean) {
  mean->resize(counts.size(), 0.0f);
  if (all == 0.0f) return;
  for (std::size_t i = 0; i < counts.size(); ++i) (*mean)[i] += share * (counts[i] / all - (*mean)[i]);
}

}  // namespace

/// Pixels on both sides of the outline in one frame.
struct RegionColors::Counts {
  std::vector<float> body = std::vector<float>(kBins, 0.0f), inside = body;
  std::array<std::vector<float>, Sectors::kCount> around;
  std::array<DepthCounts, Sectors::kCount> depth;
  float on_body = 0.0f, all_inside = 0.0f, beside = 0.0f;

  void addBody(std::size_t color, float weight, bool is_inside) {
    body[color] += weight;
    on_body += weight;
    if (!is_inside) return;
    inside[color] += 1.0f;
    all_inside += 1.0f;
  }
  void addBeside(std::size_t color, std::size_t sector, float weight,
                 const std::optional<double>& difference) {
    around[sector][color] += weight;
    beside += weight;
    if (difference) depth[sector].add(*difference, weight);
  }
};

RegionColors::RegionColors() { reset(); }

void RegionColors::reset() {
  body_.clear();
  inside_.clear();
  for (auto& sector : around_) sector.assign(kBins, 0.0f);
  for (auto& sector : log_odds_) sector.assign(kBins, 0.0f);
  depth_around_.fill({});
  depth_.fill({});
}

RegionColors::Counts RegionColors::countsIn(const RgbdFrame& frame, const RasterImage& rendered,
                                            const Labels& labels) const {
  Counts counts;
  counts.around.fill(counts.body);
  const Sectors sectors(rendered.region);
  const cv::Rect region = labels.region & cv::Rect(kInside, kInside, frame.color.cols - 2 * kInside,
                                                   frame.color.rows - 2 * kInside);
  if (region.empty()) return counts;
  const cv::Mat1f share = silhouette(rendered.depth, region);
  for (int v = region.y; v < region.br().y; v += kStep) {
    for (int u = region.x; u < region.br().x; u += kStep) {
      const std::size_t color = bin(frame.color(v, u));
      const std::uint8_t label = labels.at({u, v});
      // 1 far inside, 0 at the outline, where a pixel may show either side, and -1 far outside.
      const float sure = 2.0f * share(v - region.y, u - region.x) - 1.0f;
      if (label == labels::kBody) {
        if (sure > 0.0f) counts.addBody(color, sure, isInside(rendered.depth, u, v));
      } else if (label != labels::kUnknown || rendered.triangle(v, u) < 0) {
        const float measured = frame.depth(v, u), predicted = labels.predictedAt({u, v});
        const bool compared = measured > 0.0f && predicted > 0.0f;
        counts.addBeside(
            color, static_cast<std::size_t>(sectors.of(u, v)), std::abs(sure),
            compared ? std::optional(DepthEvidence::scaled(measured - predicted, predicted)) : std::nullopt);
      }
    }
  }
  return counts;
}

void RegionColors::learn(const RgbdFrame& frame, const RasterImage& rendered, const Labels& labels,
                         double elapsed_s) {
  const Counts counts = countsIn(frame, rendered, labels);
  if (counts.on_body < kFewest || counts.beside < kFewest) return;
  const auto share = static_cast<float>(learned() ? newestShare(elapsed_s, kMemory_s) : 1.0);
  blend(counts.body, counts.on_body, share, &body_);
  blend(counts.inside, counts.all_inside, share, &inside_);
  for (std::size_t sector = 0; sector < around_.size(); ++sector) {
    for (std::size_t i = 0; i < kBins; ++i)
      around_[sector][i] += share * (counts.around[sector][i] - around_[sector][i]);
    depth_around_[sector].blend(counts.depth[sector], share);
    depth_[sector].compare(depth_around_[sector]);
  }
  compareColors();
}

/// A sector with few pixels is like all of them.
void RegionColors::compareColors() {
  std::array<float, Sectors::kCount> pixels{};
  for (std::size_t sector = 0; sector < around_.size(); ++sector)
    pixels[sector] = std::accumulate(around_[sector].begin(), around_[sector].end(), 0.0f);
  const float all = std::accumulate(pixels.begin(), pixels.end(), 0.0f);
  for (std::size_t i = 0; i < kBins; ++i) {
    float anywhere = 0.0f;
    for (const auto& sector : around_) anywhere += sector[i] / all;
    if (body_[i] == 0.0f && anywhere == 0.0f) continue;  // never seen: its log odds are 0
    for (std::size_t sector = 0; sector < around_.size(); ++sector) {
      const float around = (around_[sector][i] + kFewest * anywhere) / (pixels[sector] + kFewest);
      log_odds_[sector][i] = std::log((body_[i] + kUnseen) / (around + kUnseen));
    }
  }
}

cv::Mat1b RegionColors::mask(const cv::Mat3b& color, const cv::Rect& region) const {
  cv::Mat1b result(color.size(), 0);
  for (int v = region.y; v < region.br().y; ++v)
    for (int u = region.x; u < region.br().x; ++u) result(v, u) = belongs(color(v, u)) ? 255 : 0;
  return result;
}

}  // namespace softbody
