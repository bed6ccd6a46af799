#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace softbody::virtual_camera {

/// Gaussian noise of unit variance on a torus, correlated over a few pixels; frames look at it through random
/// windows.
class NoiseTile {
 public:
  static constexpr int kSize = 1024;

  /// @param correlation_px standard deviation of the Gaussian filter; 0: white.
  NoiseTile(double correlation_px, std::uint64_t seed);

  /// Where a row of a frame starts. Rows of one frame belong together.
  struct Window {
    int x = 0, y = 0;
  };
  static Window window(std::uint64_t random) {
    return {static_cast<int>(random & kMask), static_cast<int>((random >> 32) & kMask)};
  }
  /// Row v of a frame; kSize columns are there, and after them it begins again.
  const float* row(const Window& window, int v) const { return tile_[(v + window.y) & kMask] + window.x; }

 private:
  static constexpr int kMask = kSize - 1;
  cv::Mat1f tile_;  ///< twice side by side
};

/// Sensor noise of the colour camera: the standard deviation grows with the brightness [grey levels of 255].
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

/// An active stereo camera (D435: 50 mm baseline, 425 px focal length at 848 x 480). Disparity d = focal_px
/// baseline_m / z carries Gaussian noise, correlated by the matching window, and is quantised: so depth errs
/// by z^2 / (focal_px baseline_m) times the disparity's error, 1.2 mm at 0.5 m by default. Every part can be
/// switched off.
struct DepthNoiseOptions {
  double focal_px = 425.0, baseline_m = 0.050;
  bool disparity_noise = true;
  double disparity_std_px = 0.1, correlation_px = 1.2;
  bool quantization = true;
  double subpixel_steps = 32.0;  ///< disparities a pixel
  bool edge_dropouts = true;     ///< what the right imager cannot see, and ragged edges
  double edge_jump_m = 0.02, edge_share = 0.35;
  bool holes = true;         ///< small spots without a match
  double hole_sigmas = 3.3;  ///< of a noise of 2 px correlation
};

class DepthNoise {
 public:
  DepthNoise(const DepthNoiseOptions& options, std::uint64_t seed);
  /// @param fx focal length of the image that the depth is registered to [px]. @param depth [m], 0: none; in
  /// place.
  void apply(int frame, double fx, cv::Mat1f* depth) const;

 private:
  void dropEdges(std::uint64_t random, double fx, cv::Mat1f* depth) const;
  void perturb(std::uint64_t random, cv::Mat1f* depth) const;
  void punchHoles(std::uint64_t random, cv::Mat1f* depth) const;

  DepthNoiseOptions options_;
  std::uint64_t seed_;
  NoiseTile disparity_tile_, hole_tile_;
};

/// Whole millimetres, 0 for none and for what does not fit.
cv::Mat1w toMillimetres(const cv::Mat1f& depth);

}  // namespace softbody::virtual_camera
