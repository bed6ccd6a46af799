#include "softbody_virtual_camera/textures/baked_texture.h"

#include <algorithm>
#include <cmath>

namespace softbody::virtual_camera {

void BakedTexture::add(const TriangleMesh& rest, const Texture& texture, const UvTexture& skin,
                       double texel_m) {
  const std::size_t first_block = blocks_.size();
  std::size_t size = texels_.size();
  for (Eigen::Index f = 0; f < rest.triangles.rows(); ++f) {
    const Eigen::RowVector3d origin = rest.vertices.row(rest.triangles(f, 0));
    const double length = std::max((rest.vertices.row(rest.triangles(f, 1)) - origin).norm(),
                                   (rest.vertices.row(rest.triangles(f, 2)) - origin).norm());
    const int cells = std::max(1, static_cast<int>(std::ceil(length / texel_m)));
    blocks_.push_back({size, cells, static_cast<float>(length / cells)});
    size += static_cast<std::size_t>(cells + 1) * static_cast<std::size_t>(cells + 1);
  }
  texels_.resize(size);
  cv::parallel_for_(cv::Range(0, static_cast<int>(rest.triangles.rows())), [&](const cv::Range& range) {
    for (int f = range.start; f < range.end; ++f) {
      const Block& block = blocks_[first_block + static_cast<std::size_t>(f)];
      const Eigen::RowVector3d origin = rest.vertices.row(rest.triangles(f, 0));
      const Eigen::RowVector3d e1 = rest.vertices.row(rest.triangles(f, 1)) - origin;
      const Eigen::RowVector3d e2 = rest.vertices.row(rest.triangles(f, 2)) - origin;
      const bool covered = skin.covers(f);
      const int level = covered ? pictureLevel(skin, rest, f, block.texel_m) : 0;
      cv::Vec4b* texel = &texels_[block.first];
      // The block covers the whole parallelogram. Its far half is needed only for interpolation along the
      // diagonal.
      for (int j = 0; j <= block.cells; ++j) {
        for (int i = 0; i <= block.cells; ++i, ++texel) {
          if (i + j > block.cells + 1) continue;
          const double w1 = static_cast<double>(i) / block.cells, w2 = static_cast<double>(j) / block.cells;
          const Eigen::Vector3f color =
              255.0f * (covered ? pictureColor(skin, f, level, w1, w2)
                                : texture((origin + w1 * e1 + w2 * e2).transpose()));
          *texel = cv::Vec4b(cv::saturate_cast<uchar>(color.x()), cv::saturate_cast<uchar>(color.y()),
                             cv::saturate_cast<uchar>(color.z()), 0);
        }
      }
    }
  });
}

}  // namespace softbody::virtual_camera
