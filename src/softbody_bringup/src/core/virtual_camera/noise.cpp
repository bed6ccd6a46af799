#include "softbody_bringup/virtual_camera/noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "softbody_bringup/virtual_camera/random.h"

namespace softbody::virtual_camera {
namespace {

constexpr float kInverseSqrt2 = 0.70710678f;

void normalize(cv::Mat1f* tile) {
  cv::Scalar mean, deviation;
  cv::meanStdDev(*tile, mean, deviation);
  *tile = (*tile - mean[0]) / deviation[0];
}

/// A Gaussian filter that wraps around.
void blurTorus(double sigma, cv::Mat1f* tile) {
  const int margin = static_cast<int>(std::ceil(4.0 * sigma));
  cv::Mat1f wide;
  cv::copyMakeBorder(*tile, wide, margin, margin, margin, margin, cv::BORDER_WRAP);
  cv::GaussianBlur(wide, wide, cv::Size(), sigma);
  wide(cv::Rect(margin, margin, tile->cols, tile->rows)).copyTo(*tile);
}

/// Where a 3 by 3 neighbourhood spans more than the jump [m], or holds a pixel without depth.
cv::Mat1b depthEdges(const cv::Mat1f& depth, double jump) {
  cv::Mat nearest, farthest;
  const cv::Mat block = cv::Mat::ones(3, 3, CV_8U);
  cv::erode(depth, nearest, block);
  cv::dilate(depth, farthest, block);
  return (farthest - nearest) > jump;
}

}  // namespace

NoiseTile::NoiseTile(double correlation_px, std::uint64_t seed) : tile_(kSize, kSize) {
  constexpr double kTwoPi = 6.28318530717958647692;
  std::uint64_t counter = 0;
  for (float& value : tile_) {  // Box and Muller 1958
    const double radius = std::sqrt(-2.0 * std::log(1.0 - unit(hash(seed, ++counter))));
    value = static_cast<float>(radius * std::cos(kTwoPi * unit(hash(seed, ++counter))));
  }
  if (correlation_px > 0.0) blurTorus(correlation_px, &tile_);
  normalize(&tile_);
}

void ColorNoise::apply(int frame, cv::Mat3b* color) const {
  if (!options_.enabled) return;
  std::array<float, 256> deviation;
  for (int level = 0; level < 256; ++level) {
    deviation[level] =
        static_cast<float>(options_.std_dark + (options_.std_bright - options_.std_dark) * level / 255.0);
  }
  const std::uint64_t random = hash(seed_, static_cast<std::uint64_t>(frame));
  cv::parallel_for_(cv::Range(0, color->rows), [&](const cv::Range& range) {
    for (int v = range.start; v < range.end; ++v) {
      // White noise: every row and channel may look at a place of its own.
      const std::uint64_t row = hash(random, static_cast<std::uint64_t>(v));
      const NoiseTile::Window windows[3] = {NoiseTile::window(row), NoiseTile::window(hash(row, 1)),
                                            NoiseTile::window(hash(row, 2))};
      for (int u = 0; u < color->cols; ++u) {
        cv::Vec3b& pixel = (*color)(v, u);
        for (int k = 0; k < 3; ++k) {
          pixel[k] = cv::saturate_cast<uchar>(pixel[k] + deviation[pixel[k]] * tile_.at(windows[k], u, 0));
        }
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
  // The threshold of a standard normal variable that the share exceeds (logistic approximation of Bowling et
  // al. 2009).
  const float threshold = static_cast<float>(std::log(1.0 / options_.edge_share - 1.0) / 1.702);
  const double shift = fx * options_.baseline_m;  // disparity on this image's grid times z [px m]
  for (int v = 0; v < depth->rows; ++v) {
    // Seen from the right imager a pixel lies at u - shift / z; a surface to its right that lands further
    // left hides it.
    double leftmost = depth->cols;
    for (int u = depth->cols - 1; u >= 0; --u) {
      float& z = (*depth)(v, u);
      if (z <= 0.0f) continue;
      const double place = u - shift / z;
      if (place > leftmost || (edges(v, u) && disparity_tile_.at(window, u, v) > threshold)) z = 0.0f;
      leftmost = std::min(leftmost, place);
    }
  }
}

void DepthNoise::perturb(std::uint64_t random, cv::Mat1f* depth) const {
  const float focal_baseline = static_cast<float>(options_.focal_px * options_.baseline_m);
  const float deviation = options_.disparity_noise ? static_cast<float>(options_.disparity_std_px) : 0.0f;
  const float steps = options_.quantization ? static_cast<float>(options_.subpixel_steps) : 0.0f;
  // Two windows added make far more patterns than the tile has places.
  const NoiseTile::Window a = NoiseTile::window(random), b = NoiseTile::window(hash(random, 1));
  cv::parallel_for_(cv::Range(0, depth->rows), [&](const cv::Range& range) {
    for (int v = range.start; v < range.end; ++v) {
      for (int u = 0; u < depth->cols; ++u) {
        float& z = (*depth)(v, u);
        if (z <= 0.0f) continue;
        const float noise = kInverseSqrt2 * (disparity_tile_.at(a, u, v) + disparity_tile_.at(b, u, v));
        float disparity = focal_baseline / z + deviation * noise;
        if (steps > 0.0f) disparity = std::nearbyint(disparity * steps) / steps;
        z = disparity > 0.0f ? focal_baseline / disparity : 0.0f;
      }
    }
  });
}

void DepthNoise::punchHoles(std::uint64_t random, cv::Mat1f* depth) const {
  const NoiseTile::Window a = NoiseTile::window(random), b = NoiseTile::window(hash(random, 1));
  const float threshold = static_cast<float>(options_.hole_sigmas);
  for (int v = 0; v < depth->rows; ++v) {
    for (int u = 0; u < depth->cols; ++u) {
      if (kInverseSqrt2 * (hole_tile_.at(a, u, v) + hole_tile_.at(b, u, v)) > threshold)
        (*depth)(v, u) = 0.0f;
    }
  }
}

cv::Mat1w toMillimetres(const cv::Mat1f& depth) {
  cv::Mat1w millimetres(depth.size());
  std::transform(depth.begin(), depth.end(), millimetres.begin(), [](float z) {
    const float mm = std::nearbyint(1000.0f * z);
    return static_cast<ushort>(mm > 0.0f && mm < 65536.0f ? mm : 0.0f);
  });
  return millimetres;
}

}  // namespace softbody::virtual_camera
