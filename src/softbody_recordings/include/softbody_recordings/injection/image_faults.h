#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

namespace softbody::injection {

/// What stands or fails in front of the camera.
struct ImageFaults {
  std::uint64_t seed = 1;
  double occluder_share = 0.0;                ///< of the image's area, 0..1; a flat, skin-coloured rectangle
  double occluder_u = 0.5, occluder_v = 0.5;  ///< its centre, in widths and heights of the image
  double occluder_m = 0.25;                   ///< its distance [m]
  double occluder_from_s = 0.0, occluder_for_s = 1e9;  ///< since the first image
  double hole_share = 0.0;       ///< of the depth image's 8 x 8 blocks, 0..1; others in every image
  double misplaced_share = 0.0;  ///< of the colour image's 24 x 24 blocks, 0..1; others in every image
};

/// The occluder's pixels, with the image's shape and inside it.
cv::Rect occluderRegion(const cv::Size& image, const ImageFaults& faults);

bool occluderPresent(double time_s, const ImageFaults& faults);

/// Paints the occluder. @param rgb whether channels are r, g, b; otherwise b, g, r.
void occludeColor(const ImageFaults& faults, bool rgb, cv::Mat3b* color);

/// Puts the occluder before all that is farther or not measured. @param depth CV_16UC1 [mm] or CV_32FC1 [m].
/// @throw std::invalid_argument for other types.
void occludeDepth(const ImageFaults& faults, cv::Mat* depth);

/// Sets exactly `round(hole_share * blocks)` blocks to 0. @param frame number of the image.
void punchHoles(const ImageFaults& faults, std::size_t frame, cv::Mat* depth);

/// Exactly `round(misplaced_share * blocks)` blocks show what is 4 to 12 px beside them: a feature is found
/// there, but in a wrong place. @param frame number of the image.
void misplaceBlocks(const ImageFaults& faults, std::size_t frame, cv::Mat3b* color);

}  // namespace softbody::injection
