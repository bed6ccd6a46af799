#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

namespace softbody::virtual_camera {

/// Slow drift of the automatic exposure and white balance, equal for the whole image.
struct ExposureDriftOptions {
  bool enabled = true;
  double exposure = 0.06;       ///< largest change of the brightness [share]
  double white_balance = 0.02;  ///< largest change of red and blue against green [share]
  double period_s = 9.0;
};

class ExposureDrift {
 public:
  ExposureDrift(const ExposureDriftOptions& options, std::uint64_t seed) : options_(options), seed_(seed) {}
  /// @param t time in the scene [s].
  void apply(double t, cv::Mat3b* color) const;

 private:
  ExposureDriftOptions options_;
  std::uint64_t seed_;
};

/// Motion blur of the colour image: the mean of several images during the exposure, around the stamp. Depth
/// is not blurred.
struct MotionBlurOptions {
  bool enabled = true;
  double exposure_s = 0.008;
  double step_px = 2.5;  ///< motion between two images, limited by max_images
  int max_images = 4;
};

/// The number of images for a motion of this length in the image during the exposure.
int blurImages(const MotionBlurOptions& options, double motion_px);

}  // namespace softbody::virtual_camera
