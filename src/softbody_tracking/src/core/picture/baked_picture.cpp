#include "picture/baked_picture.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace softbody {
namespace {

// Points of the picture along each side of a cell. Their mean is the sample.
constexpr int kPointsASide = 3;

/// The pixel at a texture coordinate. v points upwards; the picture repeats.
cv::Vec3f pixelAt(const cv::Mat3b& picture, const Eigen::RowVector3d& uv) {
  const auto wrapped = [](double place, int size) {
    return std::clamp(static_cast<int>((place - std::floor(place)) * size), 0, size - 1);
  };
  return picture(wrapped(1.0 - uv.y(), picture.rows), wrapped(uv.x(), picture.cols));
}

/// The mean in a cell. @param corners texture coordinates, one a row. @param size of the cell in weights.
cv::Vec3f meanColor(const cv::Mat3b& picture, const Eigen::Matrix3d& corners, double w1, double w2,
                    double size) {
  cv::Vec3f sum(0.0f, 0.0f, 0.0f);
  for (int i = 0; i < kPointsASide; ++i) {
    for (int j = 0; j < kPointsASide; ++j) {
      double a = w1 + size * ((i + 0.5) / kPointsASide - 0.5),
             b = w2 + size * ((j + 0.5) / kPointsASide - 0.5);
      // A point beyond the third side may have a colour of another part.
      if (const double total = a + b; total > 1.0) a /= total, b /= total;
      sum += pixelAt(picture, Eigen::RowVector3d(1.0 - a - b, a, b) * corners);
    }
  }
  return sum / static_cast<float>(kPointsASide * kPointsASide);
}

/// Corners without a coordinate are at 0, as in surface files.
bool hasColor(const Eigen::Matrix3d& corners) { return corners.allFinite() && !corners.isZero(0.0); }

}  // namespace

BakedPicture::BakedPicture(const cv::Mat3b& picture, const TriangleMesh& mesh,
                           const Points& texture_coordinates, double spacing_m) {
  const Eigen::Index triangles = mesh.triangles.rows();
  if (picture.empty() || texture_coordinates.rows() != 3 * triangles) return;
  blocks_.resize(static_cast<std::size_t>(triangles));
  for (Eigen::Index f = 0; f < triangles; ++f) {
    const Eigen::Matrix3d uv = texture_coordinates.middleRows<3>(3 * f);
    if (!hasColor(uv)) continue;
    const Eigen::RowVector3d corner = mesh.vertices.row(mesh.triangles(f, 0));
    const double side = std::max((mesh.vertices.row(mesh.triangles(f, 1)) - corner).norm(),
                                 (mesh.vertices.row(mesh.triangles(f, 2)) - corner).norm());
    Block& block = blocks_[static_cast<std::size_t>(f)];
    block = {samples_.size(), std::max(1, static_cast<int>(std::ceil(side / spacing_m)))};
    for (int j = 0; j < block.cells; ++j)
      for (int i = 0; i < block.cells; ++i)
        samples_.push_back(
            meanColor(picture, uv, (i + 0.5) / block.cells, (j + 0.5) / block.cells, 1.0 / block.cells));
  }
}

const cv::Vec3f* BakedPicture::at(int triangle, double w1, double w2) const {
  const Block& block = blocks_[static_cast<std::size_t>(triangle)];
  if (block.cells == 0) return nullptr;
  const int i = std::clamp(static_cast<int>(w1 * block.cells), 0, block.cells - 1),
            j = std::clamp(static_cast<int>(w2 * block.cells), 0, block.cells - 1);
  return &samples_[block.first + static_cast<std::size_t>(j * block.cells + i)];
}

}  // namespace softbody
