#pragma once

#include <cstddef>
#include <opencv2/core.hpp>
#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// The picture of the rest surface, sampled on its triangles, so that a pixel costs one look-up. Empty: the
/// body has no picture.
class BakedPicture {
 public:
  BakedPicture() = default;
  /// @param picture blue, green, red. @param texture_coordinates see MeshTopology; empty: no picture.
  /// @param spacing_m largest distance of the samples; each is a mean of the picture around its place [m].
  BakedPicture(const cv::Mat3b& picture, const TriangleMesh& mesh, const Points& texture_coordinates,
               double spacing_m);

  bool empty() const { return blocks_.empty(); }

  /// The colour (blue, green, red; 0..255) of a triangle at the weights of its second and third corner.
  /// nullptr: the triangle has none, for example because it fills a cut.
  const cv::Vec3f* at(int triangle, double w1, double w2) const;

 private:
  /// Samples of a triangle, at the centres of square cells over the two weights. A cell beyond the third side
  /// repeats one on it.
  struct Block {
    std::size_t first = 0;
    int cells = 0;  ///< along a side; 0: no colour
  };
  std::vector<Block> blocks_;  ///< of each triangle
  std::vector<cv::Vec3f> samples_;
};

}  // namespace softbody
