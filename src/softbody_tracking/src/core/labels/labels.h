#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "labels/label_memory.h"
#include "softbody_common/images/pixel_labels.h"

namespace softbody {

/// How far from its prediction anything is looked for in the image [rad]: 16 px with 640 x 480 pixels.
constexpr double kReach = 0.026;
/// The body is not farther from its prediction than this, along the ray [m]: 1.2 m/s at 30 Hz.
constexpr double kReach_m = 0.04;

/// What the pixels around the predicted body show. Labels belong to the image: if the prediction moves a
/// little, they stay.
struct Labels {
  cv::Rect region;     ///< the labelled part of the image [px]
  cv::Mat1b label;     ///< of each pixel of the region, see pixel_labels.h
  cv::Mat1f log_odds;  ///< of the body against everything else, for each pixel of the region
  cv::Mat1f
      predicted;  ///< depth of the body at each pixel of the region, beside it that of the nearest part [m]
  LabelMemory memory;    ///< for the next frame
  double error_m = 0.0;  ///< usual error of the prediction [m]

  /// labels::kUnknown outside of the region.
  std::uint8_t at(const cv::Point& pixel) const {
    return region.contains(pixel) ? label(pixel - region.tl()) : labels::kUnknown;
  }
  /// 255 at pixels that show the body, else 0. @param image size.
  cv::Mat1b maskOfBody(const cv::Size& image) const {
    cv::Mat1b mask(image, static_cast<std::uint8_t>(0));
    if (!region.empty()) mask(region).setTo(255, label == labels::kBody);
    return mask;
  }
  /// 0 outside of the region.
  float predictedAt(const cv::Point& pixel) const {
    return region.contains(pixel) && !predicted.empty() ? predicted(pixel - region.tl()) : 0.0f;
  }
  /// 0 outside of the region.
  float logOddsAt(const cv::Point& pixel) const {
    return region.contains(pixel) ? log_odds(pixel - region.tl()) : 0.0f;
  }
};

}  // namespace softbody
