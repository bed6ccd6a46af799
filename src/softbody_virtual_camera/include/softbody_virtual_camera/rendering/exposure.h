#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

namespace softbody::virtual_camera {

/// Automatic exposure and white balance that wander slowly, over all of the image.
struct ExposureDriftOptions {
  bool enabled = true;
  double exposure = 0.06;       ///< largest change of the brightness [share]
  double white_balance = 0.02;  ///< largest change of red and blue against green [share]
  double period_s = 9.0;
};

class ExposureDrift {
 public:
  ExposureDrift(const ExposureDriftOptions& options, std::uint64_t seed) : options_(options), seed_(seed) {}
  /// @param t time of the scene [s].
  void apply(double t, cv::Mat3b* color) const;

 private:
  ExposureDriftOptions options_;
  std::uint64_t seed_;
};

/// What moves while the shutter is open is smeared: the mean of several images within the exposure, around
/// the stamp. Depth is of the stamp.
struct MotionBlurOptions {
  bool enabled = true;
  double exposure_s = 0.008;
  double step_px = 2.5;  ///< motion between two images, as long as there are fewer than max_images
  int max_images = 4;
};

/// Number of images for a motion of this length on the image during the exposure.
int blurImages(const MotionBlurOptions& options, double motion_px);

}  // namespace softbody::virtual_camera
