#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace softbody::virtual_camera {

/// Gaussian noise of unit variance on a torus, correlated over a few pixels. Each frame uses a random window
/// of it.
class NoiseTile {
 public:
  static constexpr int kSize = 1024;

  /// @param correlation_px standard deviation of the Gaussian filter; 0: white.
  NoiseTile(double correlation_px, std::uint64_t seed);

  /// The origin of a frame in the tile.
  struct Window {
    int x = 0, y = 0;
  };
  static Window window(std::uint64_t random) {
    return {static_cast<int>(random & kMask), static_cast<int>((random >> 32) & kMask)};
  }
  /// Row v of a frame. It has kSize columns and then repeats.
  const float* row(const Window& window, int v) const { return tile_[(v + window.y) & kMask] + window.x; }

 private:
  static constexpr int kMask = kSize - 1;
  cv::Mat1f tile_;  ///< the tile, twice side by side
};

/// Sensor noise of the colour camera. The standard deviation grows with the brightness [grey levels of 255].
struct ColorNoiseOptions {
  bool enabled = true;
  double std_dark = 1.2, std_bright = 3.0;
};

class ColorNoise {
 public:
  ColorNoise(const ColorNoiseOptions& options, std::uint64_t seed)
      : options_(options), seed_(seed), tile_(0.0, seed) {}
  void apply(int frame, cv::Mat3b* color) const;

 private:
  ColorNoiseOptions options_;
  std::uint64_t seed_;
  NoiseTile tile_;
};

/// Depth noise of an active stereo camera (D435: 50 mm baseline, 425 px focal length at 848 x 480). The
/// disparity d = focal_px baseline_m / z has Gaussian noise, correlated by the matching window, and is
/// quantised. The depth error is z^2 / (focal_px baseline_m) times the disparity error: 1.2 mm at 0.5 m by
/// default.
struct DepthNoiseOptions {
  double focal_px = 425.0, baseline_m = 0.050;
  bool disparity_noise = true;
  double disparity_std_px = 0.1, correlation_px = 1.2;
  bool quantization = true;
  double subpixel_steps = 32.0;  ///< disparity steps per pixel
  bool edge_dropouts = true;     ///< pixels that the right imager cannot see, and ragged edges
  double edge_jump_m = 0.02, edge_share = 0.35;
  bool holes = true;         ///< small spots without a match
  double hole_sigmas = 3.3;  ///< holes are where noise with 2 px correlation is larger than this
};

class DepthNoise {
 public:
  DepthNoise(const DepthNoiseOptions& options, std::uint64_t seed);
  /// @param fx focal length of the image that the depth is registered to [px]. @param depth [m], 0: not
  /// measured; changed in place.
  void apply(int frame, double fx, cv::Mat1f* depth) const;

 private:
  void dropEdges(std::uint64_t random, double fx, cv::Mat1f* depth) const;
  void perturb(std::uint64_t random, cv::Mat1f* depth) const;
  void punchHoles(std::uint64_t random, cv::Mat1f* depth) const;

  DepthNoiseOptions options_;
  std::uint64_t seed_;
  NoiseTile disparity_tile_, hole_tile_;
};

/// Depth in whole millimetres; 0: not measured, or out of range.
cv::Mat1w toMillimetres(const cv::Mat1f& depth);

}  // namespace softbody::virtual_camera
