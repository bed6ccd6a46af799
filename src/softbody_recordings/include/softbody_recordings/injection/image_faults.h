#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

namespace softbody::injection {

/// Faults of the images: an occluder, holes in the depth, misplaced parts of the colour image.
struct ImageFaults {
  std::uint64_t seed = 1;
  double occluder_share = 0.0;                ///< of the image's area, 0..1; flat, skin-coloured rectangle
  double occluder_u = 0.5, occluder_v = 0.5;  ///< its centre, in widths and heights of the image
  double occluder_m = 0.25;                   ///< its distance [m]
  double occluder_from_s = 0.0, occluder_for_s = 1e9;  ///< after the first image
  double hole_share = 0.0;       ///< of the depth image's 8 x 8 blocks, 0..1; new blocks in every image
  double misplaced_share = 0.0;  ///< of the colour image's 24 x 24 blocks, 0..1; new blocks in every image
};

/// The occluder's pixels: a rectangle of the image's shape, clipped to the image.
cv::Rect occluderRegion(const cv::Size& image, const ImageFaults& faults);

/// Whether the occluder is there. @param time_s since the first image.
bool occluderPresent(double time_s, const ImageFaults& faults);

/// Draws the occluder. @param rgb whether the channels are r, g, b; otherwise b, g, r.
void occludeColor(const ImageFaults& faults, bool rgb, cv::Mat3b* color);

/// Sets the occluder's depth where the depth is larger or not measured. @param depth CV_16UC1 [mm] or
/// CV_32FC1 [m].
/// @throw std::invalid_argument for other types.
void occludeDepth(const ImageFaults& faults, cv::Mat* depth);

/// Sets exactly `round(hole_share * blocks)` blocks to 0. @param frame number of the image.
void punchHoles(const ImageFaults& faults, std::size_t frame, cv::Mat* depth);

/// Displaces exactly `round(misplaced_share * blocks)` blocks by 4 to 12 px: features are then found at wrong
/// places. @param frame number of the image.
void misplaceBlocks(const ImageFaults& faults, std::size_t frame, cv::Mat3b* color);

}  // namespace softbody::injection
