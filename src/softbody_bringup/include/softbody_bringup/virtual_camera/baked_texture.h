#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "softbody_bringup/virtual_camera/texture.h"
#include "softbody_bringup/virtual_camera/uv_texture.h"
#include "softbody_common/types.h"

namespace softbody::virtual_camera {

/// Textures sampled on the triangles, for fast look-up: every triangle owns a square block of texels
/// over its weights (w1, w2) of the second and third corner, wide enough for bilinear interpolation.
class BakedTexture {
 public:
  /// Appends a mesh's triangles. @param texture of those that the skin does not cover. @param texel_m largest
  /// spacing of the texels [m].
  void add(const TriangleMesh& rest, const Texture& texture, const UvTexture& skin, double texel_m);

  /// Spacing of a triangle's texels [m].
  float texel(int triangle) const { return blocks_[static_cast<std::size_t>(triangle)].texel_m; }

  /// Colour (0..255) in a triangle, counted over all meshes.
  cv::Vec3f at(int triangle, float w1, float w2) const {
    const Block& block = blocks_[static_cast<std::size_t>(triangle)];
    const float last = static_cast<float>(block.cells);
    const float x = std::min(std::max(w1, 0.0f), 1.0f) * last, y = std::min(std::max(w2, 0.0f), 1.0f) * last;
    const int i = std::min(static_cast<int>(x), block.cells - 1),
              j = std::min(static_cast<int>(y), block.cells - 1);
    const float s = x - static_cast<float>(i), t = y - static_cast<float>(j);
    const cv::Vec3b* row = &texels_[block.first + static_cast<std::size_t>(j * (block.cells + 1) + i)];
    const cv::Vec3b* next = row + block.cells + 1;
    const float a = (1 - s) * (1 - t), b = s * (1 - t), c = (1 - s) * t, d = s * t;
    cv::Vec3f color;
    for (int k = 0; k < 3; ++k) color[k] = a * row[0][k] + b * row[1][k] + c * next[0][k] + d * next[1][k];
    return color;
  }

 private:
  struct Block {
    std::size_t first;  ///< of its (cells + 1)^2 texels, w1 fastest
    int cells;
    float texel_m;
  };
  std::vector<Block> blocks_;
  std::vector<cv::Vec3b> texels_;
};

}  // namespace softbody::virtual_camera
