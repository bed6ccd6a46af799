#include "labels/pixel_labels.h"

#include <algorithm>
#include <cmath>

#include "labels/depth_evidence.h"

namespace softbody {
namespace {

// Largest log odds of one pixel by colour: any pixel may be wrong.
constexpr float kColorLimit = 3.0f;

float clamped(float log_odds, float limit) { return std::clamp(log_odds, -limit, limit); }

}  // namespace

/// Of the pixels of a cell.
struct PixelLabeler::Sums {
  int measured = 0, body = 0, front = 0;       ///< front: not behind the body
  float difference = 0.0f, color_odds = 0.0f;  ///< of the pixels in front
};

inline std::uint8_t PixelLabeler::labelOf(float measured, float predicted, int sector, float* log_odds,
                                          Sums* sums) const {
  if (!(measured > 0.0f)) return labels::kUnknown;
  const float of_color = *log_odds, difference = measured - predicted;
  *log_odds += clamped(colors_.depthLogOdds(difference, predicted, sector), kDepthLimit);
  const bool body = std::abs(difference) <= static_cast<float>(kReach_m) && *log_odds > 0.0f;
  const bool front = body || difference <= kBehindSurface;
  ++sums->measured;
  sums->front += front ? 1 : 0;
  sums->body += body ? 1 : 0;
  sums->difference += front ? difference : 0.0f;
  sums->color_odds += front ? of_color : 0.0f;
  return body ? labels::kBody : front ? labels::kOccluder : labels::kBackground;
}

template <typename SectorAt>
PixelLabeler::Sums PixelLabeler::labelEach(const cv::Rect& pixels, const LabelCell& cell, SectorAt sector_at,
                                           Labels* labels) const {
  Sums sums, ignored;
  const cv::Point first = labels->region.tl();
  for (int v = pixels.y; v < pixels.br().y; ++v) {
    const float *rendered = rendered_[v], *measured = frame_.depth[v];
    const cv::Vec3b* color = frame_.color[v];
    std::uint8_t* label = labels->label[v - first.y] - first.x;
    float* log_odds = labels->log_odds[v - first.y] - first.x;
    float* expected = labels->predicted[v - first.y] - first.x;
    for (int u = pixels.x; u < pixels.br().x; ++u) {
      const bool on_body = rendered[u] > 0.0f;
      const float predicted = on_body ? rendered[u] : cell.predicted;
      const int sector = sector_at(u, v);
      expected[u] = predicted;
      log_odds[u] = clamped(colors_.logOdds(color[u], sector), kColorLimit);
      const std::optional<std::uint8_t> known = knows_ ? knownLabel(u, v, predicted) : std::nullopt;
      Sums* const counted = on_body || !cell.onSurface() ? &sums : &ignored;
      label[u] = known ? *known : labelOf(measured[u], predicted, sector, &log_odds[u], counted);
    }
  }
  return sums;
}

void PixelLabeler::label(const cv::Rect& pixels, LabelCell* cell, Labels* labels) const {
  if (pixels.empty()) return;
  const int sector = sectors_.of(pixels.x, pixels.y);
  const Sums sums = sectors_.areOne(pixels)
                        ? labelEach(
                              pixels, *cell, [&](int, int) { return sector; }, labels)
                        : labelEach(
                              pixels, *cell, [&](int u, int v) { return sectors_.of(u, v); }, labels);
  cell->shows_front = sums.front > 0 && 2 * sums.front >= sums.measured;
  if (!cell->shows_front) return;
  cell->difference = sums.difference / static_cast<float>(sums.front);
  cell->color_odds = sums.color_odds / static_cast<float>(sums.front);
  cell->body = 2 * sums.body >= sums.front ? 1.0f : 0.0f;
}

/// A body that lies on a known surface agrees with it within the noise: the depth that is nearer decides.
/// Where nothing is measured, a known surface that is behind the body is not what the pixel shows.
std::optional<std::uint8_t> PixelLabeler::knownLabel(int u, int v, float predicted) const {
  if (!frame_.covered.empty() && frame_.covered(v, u) != 0) return labels::kOccluder;
  const float known = frame_.known.empty() ? 0.0f : frame_.known(v, u);
  if (!(known > 0.0f)) return std::nullopt;
  const float measured = frame_.depth(v, u);
  const bool body = rendered_(v, u) > 0.0f && std::abs(measured - predicted) < std::abs(measured - known);
  if (measured > 0.0f && body) return std::nullopt;
  if (known - predicted <= kBehindSurface) return labels::kOccluder;
  return measured > 0.0f ? std::optional(labels::kBackground) : std::nullopt;
}

void PixelLabeler::decide(const cv::Rect& pixels, const LabelCell& cell, const cv::Mat1f& mean_odds,
                          Labels* labels) const {
  const cv::Point first = labels->region.tl();
  for (int v = pixels.y; v < pixels.br().y; ++v) {
    const float *rendered = rendered_[v], *measured = frame_.depth[v];
    const float *mean = mean_odds[v - first.y] - first.x, *log_odds = labels->log_odds[v - first.y] - first.x;
    std::uint8_t* labels_here = labels->label[v - first.y] - first.x;
    for (int u = pixels.x; u < pixels.br().x; ++u) {
      if (knows_ && knownLabel(u, v, labels->predicted(v - first.y, u - first.x))) continue;
      std::uint8_t& label = labels_here[u];
      if (!(measured[u] > 0.0f))
        label = unmeasuredLabel(cell, rendered[u] > 0.0f, log_odds[u]);
      else if (label != labels::kBackground)
        label = frontLabel(cell, measured[u], rendered[u], label == labels::kBody, mean[u]);
    }
  }
}

std::uint8_t PixelLabeler::unmeasuredLabel(const LabelCell& cell, bool on_body, float log_odds) {
  if (!on_body) return log_odds > 0.0f ? labels::kUnknown : labels::kBackground;
  return cell.shows_front && !cell.showsOccluder() ? labels::kBody : labels::kUnknown;
}

std::uint8_t PixelLabeler::frontLabel(const LabelCell& cell, float measured, float rendered, bool body_alone,
                                      float mean_odds) const {
  const float difference = measured - (rendered > 0.0f ? rendered : cell.predicted);
  if (!cell.showsOccluder()) {
    const bool alone = cell.beside_occluder || rendered <= 0.0f;
    const bool body =
        alone ? body_alone : std::abs(difference) <= static_cast<float>(kReach_m) && mean_odds > 0.0f;
    return body ? labels::kBody : labels::kOccluder;
  }
  const bool nearer_to_body = difference > 0.5f * (cell.shift + cell.difference);
  if (body_alone && rendered > 0.0f && nearer_to_body) return labels::kBody;
  return cell.joined ? labels::kOccluder : labels::kBackground;
}

}  // namespace softbody
