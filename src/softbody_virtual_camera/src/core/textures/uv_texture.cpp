#include "softbody_virtual_camera/textures/uv_texture.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace softbody::virtual_camera {
namespace {

const Picture& pictureOf(const UvTexture& texture, int triangle) {
  return texture.pictures[static_cast<std::size_t>(texture.picture[static_cast<std::size_t>(triangle)])];
}

/// The texture coordinates of a triangle's corners, one per row.
Eigen::Matrix3d cornersOf(const UvTexture& texture, Eigen::Index triangle) {
  return texture.coordinates.middleRows<3>(3 * triangle);
}

/// A pixel's index in a repeating image.
int wrapped(double place, int size) {
  const double turns = std::floor(place / size);
  return std::clamp(static_cast<int>(place - turns * size), 0, size - 1);
}

}  // namespace

Picture makePicture(const cv::Mat3b& image) {
  Picture picture = {image};
  while (std::min(picture.back().rows, picture.back().cols) > 1) {
    cv::Mat3b half;
    cv::resize(picture.back(), half, cv::Size(), 0.5, 0.5, cv::INTER_AREA);
    picture.push_back(half);
  }
  return picture;
}

int pictureLevel(const UvTexture& texture, const TriangleMesh& rest, int triangle, double texel_m) {
  const Eigen::Vector3d size(pictureOf(texture, triangle).front().cols,
                             pictureOf(texture, triangle).front().rows, 0.0);
  const auto doubleArea = [](const Eigen::Matrix3d& corners) {
    return (corners.row(1) - corners.row(0)).cross(corners.row(2) - corners.row(0)).norm();
  };
  const Eigen::Matrix3d pixels = cornersOf(texture, triangle) * size.asDiagonal();
  const Eigen::Matrix3d places = rest.vertices(rest.triangles.row(triangle).transpose(), Eigen::all);
  const double pixels_a_texel = texel_m * std::sqrt(doubleArea(pixels) / std::max(doubleArea(places), 1e-18));
  const int level = static_cast<int>(std::lround(std::log2(std::max(pixels_a_texel, 1.0))));
  return std::min(level, static_cast<int>(pictureOf(texture, triangle).size()) - 1);
}

Eigen::Vector3f pictureColor(const UvTexture& texture, int triangle, int level, double w1, double w2) {
  const cv::Mat3b& image = pictureOf(texture, triangle)[static_cast<std::size_t>(level)];
  const Eigen::RowVector3d uv = Eigen::RowVector3d(1.0 - w1 - w2, w1, w2) * cornersOf(texture, triangle);
  const double x = uv.x() * image.cols - 0.5, y = (1.0 - uv.y()) * image.rows - 0.5;
  const double s = x - std::floor(x), t = y - std::floor(y);
  const int left = wrapped(std::floor(x), image.cols), right = wrapped(std::floor(x) + 1.0, image.cols);
  const int above = wrapped(std::floor(y), image.rows), below = wrapped(std::floor(y) + 1.0, image.rows);
  Eigen::Vector3f color;
  for (int k = 0; k < 3; ++k) {
    const double upper = (1.0 - s) * image(above, left)[k] + s * image(above, right)[k];
    const double lower = (1.0 - s) * image(below, left)[k] + s * image(below, right)[k];
    color[k] = static_cast<float>(((1.0 - t) * upper + t * lower) / 255.0);
  }
  return color;
}

}  // namespace softbody::virtual_camera
