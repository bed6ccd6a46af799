#include "softbody_virtual_camera/rendering/noise.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "softbody_common/statistics/random.h"

namespace softbody::virtual_camera {
namespace {

constexpr float kInverseSqrt2 = 0.70710678f;

void normalize(cv::Mat1f* tile) {
  cv::Scalar mean, deviation;
  cv::meanStdDev(*tile, mean, deviation);
  *tile = (*tile - mean[0]) / deviation[0];
}

/// A Gaussian filter with periodic boundaries.
void blurTorus(double sigma, cv::Mat1f* tile) {
  const int margin = static_cast<int>(std::ceil(4.0 * sigma));
  cv::Mat1f wide;
  cv::copyMakeBorder(*tile, wide, margin, margin, margin, margin, cv::BORDER_WRAP);
  cv::GaussianBlur(wide, wide, cv::Size(), sigma);
  wide(cv::Rect(margin, margin, tile->cols, tile->rows)).copyTo(*tile);
}

/// Mask of pixels whose 3 by 3 neighbourhood has a larger depth range than the jump [m], or a pixel without
/// depth.
cv::Mat1b depthEdges(const cv::Mat1f& depth, double jump) {
  cv::Mat nearest, farthest;
  const cv::Mat block = cv::Mat::ones(3, 3, CV_8U);
  cv::erode(depth, nearest, block);
  cv::dilate(depth, farthest, block);
  return (farthest - nearest) > jump;
}

/// Rounds a number below 2^22, in loops that the compiler can vectorise.
float rounded(float value) {
  constexpr float kShift = 12582912.0f;  // 1.5 * 2^23 leaves no bits for a fraction
  return (value + kShift) - kShift;
}

/// Calls set(u, noise) along a row, with the normalised sum of two rows of tiles.
template <class Set>
void addPairs(const float* a, const float* b, int cols, const Set& set) {
  for (int first = 0; first < cols; first += NoiseTile::kSize) {
    const int count = std::min(NoiseTile::kSize, cols - first);
    for (int i = 0; i < count; ++i) set(first + i, kInverseSqrt2 * (a[i] + b[i]));
  }
}

/// Adds noise with a standard deviation of dark + slope * value.
void addNoise(float dark, float slope, const float* noise, int count, uchar* values) {
  for (int i = 0; i < count; ++i) {
    const float value = values[i];
    const float noisy = value + (dark + slope * value) * noise[i] + 0.5f;
    values[i] = static_cast<uchar>(static_cast<int>(std::min(std::max(noisy, 0.0f), 255.0f)));
  }
}

}  // namespace

NoiseTile::NoiseTile(double correlation_px, std::uint64_t seed) {
  constexpr double kTwoPi = 6.28318530717958647692;
  std::uint64_t counter = 0;
  cv::Mat1f tile(kSize, kSize);
  for (float& value : tile) {  // Box and Muller 1958
    const double radius = std::sqrt(-2.0 * std::log(1.0 - unit(hash(seed, ++counter))));
    value = static_cast<float>(radius * std::cos(kTwoPi * unit(hash(seed, ++counter))));
  }
  if (correlation_px > 0.0) blurTorus(correlation_px, &tile);
  normalize(&tile);
  cv::hconcat(tile, tile, tile_);
}

void ColorNoise::apply(int frame, cv::Mat3b* color) const {
  if (!options_.enabled) return;
  const float dark = static_cast<float>(options_.std_dark),
              slope = static_cast<float>((options_.std_bright - options_.std_dark) / 255.0);
  const std::uint64_t random = hash(seed_, static_cast<std::uint64_t>(frame));
  const int values = 3 * color->cols;
  cv::parallel_for_(cv::Range(0, color->rows), [&](const cv::Range& range) {
    for (int v = range.start; v < range.end; ++v) {
      // The noise is white, so every part of a row can use another window.
      const std::uint64_t row = hash(random, static_cast<std::uint64_t>(v));
      for (int first = 0; first < values; first += NoiseTile::kSize) {
        const float* noise = tile_.row(NoiseTile::window(hash(row, static_cast<std::uint64_t>(first))), 0);
        addNoise(dark, slope, noise, std::min(NoiseTile::kSize, values - first),
                 color->ptr<uchar>(v) + first);
      }
    }
  });
}

DepthNoise::DepthNoise(const DepthNoiseOptions& options, std::uint64_t seed)
    : options_(options),
      seed_(seed),
      disparity_tile_(options.correlation_px, hash(seed, 1)),
      hole_tile_(2.0, hash(seed, 2)) {}

void DepthNoise::apply(int frame, double fx, cv::Mat1f* depth) const {
  const std::uint64_t random = hash(seed_, static_cast<std::uint64_t>(frame));
  if (options_.edge_dropouts) dropEdges(hash(random, 1), fx, depth);
  if (options_.disparity_noise || options_.quantization) perturb(hash(random, 2), depth);
  if (options_.holes) punchHoles(hash(random, 3), depth);
}

void DepthNoise::dropEdges(std::uint64_t random, double fx, cv::Mat1f* depth) const {
  const cv::Mat1b edges = depthEdges(*depth, options_.edge_jump_m);
  const NoiseTile::Window window = NoiseTile::window(random);
  // The threshold that this share of a standard normal variable exceeds (logistic approximation of Bowling et
  // al. 2009).
  const float threshold = static_cast<float>(std::log(1.0 / options_.edge_share - 1.0) / 1.702);
  const double shift = fx * options_.baseline_m;  // disparity on this image's grid times z [px m]
  for (int v = 0; v < depth->rows; ++v) {
    // In the right imager a pixel is at u - shift / z. A surface to its right hides it if it is further left
    // there.
    const float* ragged = disparity_tile_.row(window, v);
    double leftmost = depth->cols;
    for (int u = depth->cols - 1; u >= 0; --u) {
      float& z = (*depth)(v, u);
      if (z <= 0.0f) continue;
      const double place = u - shift / z;
      if (place > leftmost || (edges(v, u) && ragged[u % NoiseTile::kSize] > threshold)) z = 0.0f;
      leftmost = std::min(leftmost, place);
    }
  }
}

void DepthNoise::perturb(std::uint64_t random, cv::Mat1f* depth) const {
  const float focal_baseline = static_cast<float>(options_.focal_px * options_.baseline_m);
  const float deviation = options_.disparity_noise ? static_cast<float>(options_.disparity_std_px) : 0.0f;
  const float steps = options_.quantization ? static_cast<float>(options_.subpixel_steps) : 0.0f;
  // The sum of two windows gives many more patterns than one window.
  const NoiseTile::Window a = NoiseTile::window(random), b = NoiseTile::window(hash(random, 1));
  cv::parallel_for_(cv::Range(0, depth->rows), [&](const cv::Range& range) {
    for (int v = range.start; v < range.end; ++v) {
      float* row = (*depth)[v];
      addPairs(disparity_tile_.row(a, v), disparity_tile_.row(b, v), depth->cols, [=](int u, float noise) {
        float& z = row[u];
        float disparity = focal_baseline / z + deviation * noise;
        const float quantized = rounded(disparity * steps) / steps;
        disparity = steps > 0.0f ? quantized : disparity;
        const float noisy = focal_baseline / disparity;
        z = (z > 0.0f) & (disparity > 0.0f) ? noisy : 0.0f;
      });
    }
  });
}

void DepthNoise::punchHoles(std::uint64_t random, cv::Mat1f* depth) const {
  const NoiseTile::Window a = NoiseTile::window(random), b = NoiseTile::window(hash(random, 1));
  const float threshold = static_cast<float>(options_.hole_sigmas);
  for (int v = 0; v < depth->rows; ++v) {
    float* z = (*depth)[v];
    addPairs(hole_tile_.row(a, v), hole_tile_.row(b, v), depth->cols,
             [=](int u, float noise) { z[u] = noise > threshold ? 0.0f : z[u]; });
  }
}

cv::Mat1w toMillimetres(const cv::Mat1f& depth) {
  cv::Mat1w millimetres(depth.size());
  for (int v = 0; v < depth.rows; ++v) {
    std::transform(depth[v], depth[v] + depth.cols, millimetres[v], [](float z) {
      const float mm = rounded(1000.0f * z);
      return static_cast<ushort>(static_cast<int>((mm > 0.0f) & (mm < 65536.0f) ? mm : 0.0f));
    });
  }
  return millimetres;
}

}  // namespace softbody::virtual_camera
