#pragma once

#include <opencv2/core.hpp>
#include <opencv2/core/hal/intrin.hpp>
#include <vector>

#include "softbody_common/geometry/types.h"
#include "softbody_virtual_camera/textures/texture.h"
#include "softbody_virtual_camera/textures/uv_texture.h"

namespace softbody::virtual_camera {

/// Textures, sampled on the triangles for fast look-up. Every triangle has a square block of texels over the
/// weights (w1, w2) of its second and third corner, with a margin for bilinear interpolation.
class BakedTexture {
 public:
  /// Appends a mesh's triangles. @param texture of triangles that the skin does not cover.
  /// @param texel_m largest spacing of the texels [m].
  void add(const TriangleMesh& rest, const Texture& texture, const UvTexture& skin, double texel_m);

  /// Spacing of a triangle's texels [m].
  float texel(int triangle) const { return blocks_[static_cast<std::size_t>(triangle)].texel_m; }

  /// Prefetches a triangle's texels, because the cache is too small for all texels.
  void prefetch(int triangle) const {
    constexpr std::size_t kLine = 64 / sizeof(cv::Vec4b);
    const cv::Vec4b* texel = texels_.data() + blocks_[static_cast<std::size_t>(triangle)].first;
    for (std::size_t line = 0; line < 3; ++line) __builtin_prefetch(texel + line * kLine);
  }

  /// Colour (0..255; r, g, b, 0) in a triangle. @param triangle index over all meshes.
  cv::v_float32x4 at(int triangle, float w1, float w2) const {
    const Block& block = blocks_[static_cast<std::size_t>(triangle)];
    const float last = static_cast<float>(block.cells);
    const float x = std::min(std::max(w1, 0.0f), 1.0f) * last, y = std::min(std::max(w2, 0.0f), 1.0f) * last;
    const int i = std::min(static_cast<int>(x), block.cells - 1),
              j = std::min(static_cast<int>(y), block.cells - 1);
    const float s = x - static_cast<float>(i), t = y - static_cast<float>(j);
    const cv::Vec4b* row = &texels_[block.first + static_cast<std::size_t>(j * (block.cells + 1) + i)];
    const cv::Vec4b* next = row + block.cells + 1;
    const auto weighted = [](float weight, const cv::Vec4b& texel) {
      return cv::v_setall_f32(weight) *
             cv::v_cvt_f32(cv::v_reinterpret_as_s32(cv::v_load_expand_q(texel.val)));
    };
    return (weighted((1 - s) * (1 - t), row[0]) + weighted(s * (1 - t), row[1])) +
           (weighted((1 - s) * t, next[0]) + weighted(s * t, next[1]));
  }

 private:
  struct Block {
    std::size_t first;  ///< of its (cells + 1)^2 texels, w1 fastest
    int cells;
    float texel_m;
  };
  std::vector<Block> blocks_;
  std::vector<cv::Vec4b> texels_;  ///< r, g, b, 0
};

}  // namespace softbody::virtual_camera
