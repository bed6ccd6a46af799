#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "features/gray_pyramid.h"
#include "features/patch_kernel.h"

namespace softbody {

/// What a feature's surroundings looked like when it was bound, for sub-pixel alignment (inverse
/// compositional Lucas-Kanade, Baker and Matthews 2004; gain and offset of the brightness are free).
class FeaturePatch {
 public:
  struct Alignment {
    cv::Point2f pixel;         ///< in the frame
    float correlation = 0.0f;  ///< normalised, at full resolution; -1..1
  };

  /// @return false if the pixel is too near to the region's border, or its surroundings do not fix a
  /// position.
  bool learn(const GrayPyramid& image, const cv::Point2f& pixel);

  /// Looks for the patch from a start, from the given level of the pyramid down to full resolution.
  /// @param warp how the surface shows now: pixels of this frame per pixel of the one where it was learned.
  /// @return correlation -1 where it leaves the image.
  Alignment align(const GrayPyramid& image, const Eigen::Matrix2f& warp, const cv::Point2f& start,
                  int coarsest_level) const;

  /// Has what align() reads at full resolution brought into the cache: other patches have driven it out.
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

  std::vector<Level> levels_;  ///< full resolution first; coarser ones as far as they fix a position
};

}  // namespace softbody
