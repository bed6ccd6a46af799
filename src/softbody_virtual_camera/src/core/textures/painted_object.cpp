#include "textures/painted_object.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "softbody_common/files/staged_output.h"
#include "softbody_sim/io/textured_mesh_file.h"

namespace softbody::virtual_camera {
namespace {

constexpr double kPixel = 1e-3;  // of the picture on the body [m]
constexpr int kMargin = 1;       // pixels around a triangle, for interpolation

/// A square of the picture with one triangle. Its corners are at pixel centres: weights (0, 0), (1, 0), (0,
/// 1).
struct Square {
  cv::Point corner;  ///< of its first pixel
  int cells = 1;     ///< pixels between two corners
  int side() const { return cells + 1 + 2 * kMargin; }
};

/// Side by side in rows, about as wide as high in all.
std::vector<Square> layOut(const TriangleMesh& mesh, cv::Size* size) {
  std::vector<Square> squares;
  double pixels = 0.0;
  for (const auto& triangle : mesh.triangles.rowwise()) {
    const Eigen::RowVector3d corner = mesh.vertices.row(triangle[0]);
    const double length = std::max((mesh.vertices.row(triangle[1]) - corner).norm(),
                                   (mesh.vertices.row(triangle[2]) - corner).norm());
    squares.push_back({{}, std::max(1, static_cast<int>(std::ceil(length / kPixel)))});
    pixels += squares.back().side() * squares.back().side();
  }
  const int width = static_cast<int>(std::ceil(std::sqrt(pixels)));
  cv::Point next;
  int row = 0;
  for (Square& square : squares) {
    if (next.x > 0 && next.x + square.side() > width) next = {0, next.y + row}, row = 0;
    square.corner = next;
    next.x += square.side();
    row = std::max(row, square.side());
    *size = {std::max(size->width, next.x), std::max(size->height, next.y + row)};
  }
  return squares;
}

/// The colours of one triangle. A solid texture goes on beyond its sides.
void paint(const TriangleMesh& rest, const Texture& texture, Eigen::Index f, const Square& square,
           cv::Mat3b* picture) {
  const auto corner = [&](int k) -> Eigen::Vector3d {
    return rest.vertices.row(rest.triangles(f, k)).transpose();
  };
  for (int y = 0; y < square.side(); ++y) {
    for (int x = 0; x < square.side(); ++x) {
      const double w1 = static_cast<double>(x - kMargin) / square.cells,
                   w2 = static_cast<double>(y - kMargin) / square.cells;
      const Eigen::Vector3f color =
          255.0f * texture((1.0 - w1 - w2) * corner(0) + w1 * corner(1) + w2 * corner(2));
      (*picture)(square.corner + cv::Point(x, y)) =
          cv::Vec3b(cv::saturate_cast<uchar>(color.z()), cv::saturate_cast<uchar>(color.y()),
                    cv::saturate_cast<uchar>(color.x()));
    }
  }
}

/// Of the three corners.
Points coordinatesIn(const cv::Size& size, const Square& square) {
  Points uv = Points::Zero(3, 3);
  const cv::Point offsets[3] = {{0, 0}, {square.cells, 0}, {0, square.cells}};
  for (int k = 0; k < 3; ++k) {
    const cv::Point pixel = square.corner + cv::Point(kMargin, kMargin) + offsets[k];
    uv.row(k) << (pixel.x + 0.5) / size.width, 1.0 - (pixel.y + 0.5) / size.height, 0.0;
  }
  return uv;
}

}  // namespace

void writePaintedObject(const TriangleMesh& rest, const Texture& texture,
                        const std::filesystem::path& folder) {
  cv::Size size;
  const std::vector<Square> squares = layOut(rest, &size);
  cv::Mat3b picture(size, cv::Vec3b(0, 0, 0));
  Points coordinates(3 * rest.triangles.rows(), 3);
  for (Eigen::Index f = 0; f < rest.triangles.rows(); ++f) {
    const Square& square = squares[static_cast<std::size_t>(f)];
    paint(rest, texture, f, square, &picture);
    coordinates.middleRows<3>(3 * f) = coordinatesIn(size, square);
  }
  StagedFolder staged(folder);
  writeTexturedObj(staged.path() / "visual.obj", rest, coordinates, picture);
  writeBytes(staged.path() / "object.yaml", "object: {visual_mesh: visual.obj, unit: m}\n");
  staged.replaceTarget();
}

}  // namespace softbody::virtual_camera
