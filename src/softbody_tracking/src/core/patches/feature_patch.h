#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "patches/gray_pyramid.h"
#include "patches/patch_kernel.h"

namespace softbody {

/// The image around a feature when it was bound, for sub-pixel alignment (inverse compositional Lucas-Kanade,
/// Baker and Matthews 2004). Gain and offset of the brightness are free.
class FeaturePatch {
 public:
  struct Alignment {
    cv::Point2f pixel;         ///< in the frame
    float correlation = 0.0f;  ///< normalised, at full resolution; -1..1
  };

  /// Learns the patch. @return false if the pixel is too close to the region's border, or if the patch does
  /// not determine a position.
  bool learn(const GrayPyramid& image, const cv::Point2f& pixel);

  /// Searches for the patch, from a level of the pyramid down to full resolution.
  /// @param warp pixels of this frame per pixel of the frame where it was learned.
  /// @return correlation -1 if the search leaves the image.
  Alignment align(const GrayPyramid& image, const Eigen::Matrix2f& warp, const cv::Point2f& start,
                  int coarsest_level) const;

  /// Loads what align() reads at full resolution into the cache.
  void prefetch() const;

 private:
  struct Level {
    PatchTemplate pattern;
    float dx_offset, dy_offset;  ///< products of the pattern's values with its derivatives
    Eigen::Matrix2f inverse_hessian;
  };

  static bool learnLevel(const RowPairs& image, const cv::Point2f& center, Level* level);
  static float alignLevel(const Level& level, const RowPairs& image, const Eigen::Matrix2f& warp,
                          cv::Point2f* center);

  std::vector<Level> levels_;  ///< full resolution first; then coarser ones that determine a position
};

}  // namespace softbody
