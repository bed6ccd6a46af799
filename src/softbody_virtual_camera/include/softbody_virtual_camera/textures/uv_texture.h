#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "softbody_common/types.h"

namespace softbody::virtual_camera {

/// An image (r, g, b) and its halves, quarters and so on, so that it can be sampled coarsely without
/// aliasing.
using Picture = std::vector<cv::Mat3b>;
Picture makePicture(const cv::Mat3b& image);

/// Pictures laid on a mesh by texture coordinates. Empty: none.
struct UvTexture {
  Points coordinates;        ///< 3 #F rows (u, v, 0), in the order of the triangles' corners; v upwards
  std::vector<int> picture;  ///< #F: which picture a triangle shows, -1: none
  std::vector<Picture> pictures;

  bool covers(int triangle) const {
    return !picture.empty() && picture[static_cast<std::size_t>(triangle)] >= 0;
  }
};

/// Level of its picture with about one pixel or less for each texel of a triangle.
int pictureLevel(const UvTexture& texture, const TriangleMesh& rest, int triangle, double texel_m);

/// Colour (r, g, b in 0..1) of a covered triangle at the weights of its second and third corner, bilinear;
/// pictures repeat.
Eigen::Vector3f pictureColor(const UvTexture& texture, int triangle, int level, double w1, double w2);

}  // namespace softbody::virtual_camera
