#pragma once

#include <opencv2/core.hpp>

#include "softbody_scanning/fusion/depth_view.h"

namespace softbody::scanning {

/// What a view says about a block of space as a whole.
enum class BlockSight { kNone, kEmpty, kHidden, kMixed };

/// Least and largest depth of a view's cells of pixels, to decide about whole blocks.
class DepthRange {
 public:
  explicit DepthRange(const DepthView& view);

  /// @param center in the camera frame [m]. @param radius of a ball around the block [m]. @param reach see
  /// FusionBox.
  BlockSight sightOf(const Eigen::Vector3d& center, double radius, double reach) const;

 private:
  Pinhole camera_;
  cv::Mat2f cells_;  // least `nearest` and largest depth; 0 and infinity where a pixel has no depth
};

}  // namespace softbody::scanning
