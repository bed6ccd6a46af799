#include "comparison/overlay_drawing.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "softbody_common/images/rasterizer.h"

namespace softbody::evaluation {
namespace {

constexpr int kLines = 9;         ///< along the longest side of the body
constexpr double kBehind = 0.01;  ///< relative depth by which a line may lie behind the surface
constexpr int kFractionBits = 4;
const cv::Scalar kOutline(60, 255, 60), kLine(255, 230, 80);

/// Planes at equal distance that are perpendicular to an axis, none of them through the end of the body.
struct Planes {
  double middle, spacing;

  /// The coordinate in which the planes are the integers.
  double number(double rest) const { return (rest - middle) / spacing + 0.5; }
};

cv::Point fixedPoint(const Eigen::Vector2d& pixel) {
  const double one = 1 << kFractionBits;
  return {static_cast<int>(std::lround(one * pixel.x())), static_cast<int>(std::lround(one * pixel.y()))};
}

bool isSeen(const Eigen::Vector3d& p, const Pinhole& camera, const cv::Mat1f& depth) {
  if (p.z() <= 0.01) return false;
  const Eigen::Vector2d pixel = camera.project(p);
  if (!camera.contains(pixel.x(), pixel.y())) return false;
  const float front =
      depth(static_cast<int>(std::lround(pixel.y())), static_cast<int>(std::lround(pixel.x())));
  return p.z() < (1.0 + kBehind) * front;
}

/// Where one plane cuts a triangle. @param numbers of its corners. @param corners as columns.
void drawCrossing(const Eigen::Vector3d& numbers, const Eigen::Matrix3d& corners, double plane,
                  const Pinhole& camera, const cv::Mat1f& depth, cv::Mat3b* image) {
  Eigen::Vector3d ends[3];
  int found = 0;
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    if ((numbers[k] < plane) == (numbers[next] < plane)) continue;
    const double t = (plane - numbers[k]) / (numbers[next] - numbers[k]);
    ends[found++] = corners.col(k) + t * (corners.col(next) - corners.col(k));
  }
  if (found < 2 || !isSeen(0.5 * (ends[0] + ends[1]), camera, depth)) return;
  cv::line(*image, fixedPoint(camera.project(ends[0])), fixedPoint(camera.project(ends[1])), kLine, 1,
           cv::LINE_AA, kFractionBits);
}

void drawLines(const Pinhole& camera, const Points& vertices, const MeshTopology& mesh,
               const cv::Mat1f& depth, cv::Mat3b* image) {
  const Eigen::RowVector3d low = mesh.rest_vertices.colwise().minCoeff(),
                           high = mesh.rest_vertices.colwise().maxCoeff();
  const double spacing = (high - low).maxCoeff() / kLines;
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k) corners.col(k) = vertices.row(mesh.triangles(f, k));
    for (int axis = 0; axis < 3; ++axis) {
      const Planes planes{0.5 * (low[axis] + high[axis]), spacing};
      Eigen::Vector3d numbers;
      for (int k = 0; k < 3; ++k) numbers[k] = planes.number(mesh.rest_vertices(mesh.triangles(f, k), axis));
      for (double plane = std::ceil(numbers.minCoeff()); plane <= numbers.maxCoeff(); plane += 1.0)
        drawCrossing(numbers, corners, plane, camera, depth, image);
    }
  }
}

}  // namespace

void drawOutlineAndLines(const Pinhole& camera, const Points& vertices, const MeshTopology& mesh,
                         cv::Mat3b* image) {
  RasterImage raster;
  rasterize(camera, vertices, mesh.triangles, &raster);
  cv::Mat3b lines = image->clone();
  drawLines(camera, vertices, mesh, raster.depth, &lines);
  cv::addWeighted(lines, 0.6, *image, 0.4, 0.0, *image);
  std::vector<std::vector<cv::Point>> outlines;
  cv::findContours(cv::Mat1b(raster.depth > 0.0f), outlines, cv::RETR_LIST, cv::CHAIN_APPROX_SIMPLE);
  cv::drawContours(*image, outlines, -1, kOutline, 2, cv::LINE_AA);
}

}  // namespace softbody::evaluation
