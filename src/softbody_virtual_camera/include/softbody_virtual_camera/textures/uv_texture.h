#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody::virtual_camera {

/// An image pyramid (r, g, b): the image, half of its size, a quarter and so on, to sample it without
/// aliasing.
using Picture = std::vector<cv::Mat3b>;
Picture makePicture(const cv::Mat3b& image);

/// Images on a mesh, placed by texture coordinates. Empty: no image.
struct UvTexture {
  Points coordinates;        ///< 3 #F rows (u, v, 0), in the order of the triangles' corners; v upwards
  std::vector<int> picture;  ///< #F: index of the triangle's picture; -1: none
  std::vector<Picture> pictures;

  bool covers(int triangle) const {
    return !picture.empty() && picture[static_cast<std::size_t>(triangle)] >= 0;
  }
};

/// The level of a triangle's picture with at most about one pixel per texel.
int pictureLevel(const UvTexture& texture, const TriangleMesh& rest, int triangle, double texel_m);

/// Colour (r, g, b in 0..1) of a covered triangle at the weights of its second and third corner, by bilinear
/// interpolation. Pictures repeat.
Eigen::Vector3f pictureColor(const UvTexture& texture, int triangle, int level, double w1, double w2);

}  // namespace softbody::virtual_camera
