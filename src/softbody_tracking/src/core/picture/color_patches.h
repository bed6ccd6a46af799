#pragma once

#include <Eigen/Geometry>
#include <opencv2/core.hpp>
#include <vector>

#include "picture/baked_picture.h"
#include "softbody_common/geometry/types.h"
#include "softbody_tracking/rgbd_frame.h"

namespace softbody {

/// Side of a patch [px of an image of kLargeColumns]: larger than the error of a pose that a search leaves.
constexpr int kPatchPixels = 5;

/// What the picture and the image show in one square patch of the image.
struct ColorPatch {
  cv::Point cell;            ///< column and row of the patch
  Eigen::Vector3d pictured;  ///< natural logarithms of the mean blue, green and red (1..255)
  Eigen::Vector3d seen;      ///< the same in the image
  Eigen::Vector3d normal;    ///< mean of the surface there, camera frame
};

/// A frame in which each pixel is a mean of its neighbourhood, as large as the images of a search: to compare
/// its colours, not its depth.
RgbdFrame colorFrame(const RgbdFrame& frame);

/// The patches in which at least half of the pixels show the posed mesh by their depth.
/// @param frame from colorFrame().
std::vector<ColorPatch> colorPatches(const RgbdFrame& frame, const TriangleMesh& mesh,
                                     const BakedPicture& picture, const Eigen::Isometry3d& pose);

}  // namespace softbody
