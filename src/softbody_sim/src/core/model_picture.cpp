#include "model_picture.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "softbody_common/rasterizer.h"
#include "softbody_common/tet_geometry.h"
#include "surface_repair.h"

namespace softbody {
namespace {

constexpr int kWidth = 560, kHeight = 480;
constexpr int kOversampling = 2;       ///< drawn larger, then averaged
constexpr double kDistance = 4.0;      ///< of the camera from the middle [size]
constexpr double kEdgeWidth_px = 1.6;  ///< half of a drawn edge, oversampled

/// Rest frame in the frame of a camera that looks at the middle from the front, the left and above.
Eigen::Isometry3d cameraPose(const Points& points) {
  const Eigen::Vector3d middle =
      0.5 * (points.colwise().minCoeff() + points.colwise().maxCoeff()).transpose();
  const Eigen::Vector3d forward = Eigen::Vector3d(0.6, 1.0, -0.55).normalized();
  const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() << right.transpose(), forward.cross(right).transpose(), forward.transpose();
  pose.translation() = kDistance * sizeOf(points) * Eigen::Vector3d::UnitZ() - pose.linear() * middle;
  return pose;
}

/// Such that the points, seen from there, just fit into the picture.
Pinhole makeCamera(const Points& seen) {
  Pinhole camera;
  camera.width = kOversampling * kWidth;
  camera.height = kOversampling * kHeight;
  const double right = seen.col(0).cwiseQuotient(seen.col(2)).cwiseAbs().maxCoeff();
  const double down = seen.col(1).cwiseQuotient(seen.col(2)).cwiseAbs().maxCoeff();
  camera.fx = camera.fy = 0.47 * std::min(camera.width / right, camera.height / down);
  camera.cx = 0.5 * (camera.width - 1);
  camera.cy = 0.5 * (camera.height - 1);
  return camera;
}

Points transformed(const Points& points, const Eigen::Isometry3d& pose) {
  return (points * pose.linear().transpose()).rowwise() + pose.translation().transpose();
}

/// Pixels from the visible point to the nearest edge of its triangle.
double distanceToEdge(const Eigen::Vector2d (&corners)[3], const Eigen::Vector2d& pixel) {
  double nearest = 1e9;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector2d edge = corners[(k + 1) % 3] - corners[k], offset = pixel - corners[k];
    nearest = std::min(nearest,
                       std::abs(edge.x() * offset.y() - edge.y() * offset.x()) / std::max(edge.norm(), 1e-9));
  }
  return nearest;
}

cv::Mat3b drawSurface(const Points& vertices, const Triangles& triangles, const Eigen::Isometry3d& pose,
                      const Pinhole& camera, const cv::Vec3d& color, bool edges) {
  const Points seen = transformed(vertices, pose);
  RasterImage raster;
  rasterize(camera, seen, triangles, &raster);
  cv::Mat3b image(camera.height, camera.width, cv::Vec3b(255, 255, 255));
  const Eigen::Vector3d light = Eigen::Vector3d(-0.4, -0.7, -1.0).normalized();
  for (int v = 0; v < image.rows; ++v) {
    for (int u = 0; u < image.cols; ++u) {
      const int f = raster.triangle(v, u);
      if (f < 0) continue;
      Eigen::Vector3d p[3];
      Eigen::Vector2d corners[3];
      for (int k = 0; k < 3; ++k) {
        p[k] = seen.row(triangles(f, k));
        corners[k] = camera.project(p[k]);
      }
      const double facing = (p[1] - p[0]).cross(p[2] - p[0]).normalized().dot(light);
      const bool on_edge = edges && distanceToEdge(corners, {u, v}) < kEdgeWidth_px;
      const double shade = on_edge ? 0.25 : 0.45 + 0.55 * std::max(0.0, facing);
      image(v, u) = cv::Vec3b(shade * color);
    }
  }
  cv::resize(image, image, {kWidth, kHeight}, 0.0, 0.0, cv::INTER_AREA);
  return image;
}

/// Boundary of the tets beyond the middle, as seen by the camera.
Triangles farHalf(const TetTopology& volume, const Eigen::Isometry3d& pose) {
  std::vector<double> depths;
  for (const auto& tet : volume.tets.rowwise()) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const int v : tet) sum += volume.rest_vertices.row(v).transpose();
    depths.push_back((pose * (0.25 * sum)).z());
  }
  std::vector<double> sorted = depths;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2),
                   sorted.end());
  std::vector<Eigen::Index> far;
  for (std::size_t t = 0; t < depths.size(); ++t) {
    if (depths[t] >= sorted[sorted.size() / 2]) far.push_back(static_cast<Eigen::Index>(t));
  }
  return boundaryTriangles(Tets(volume.tets(far, Eigen::all)));
}

}  // namespace

cv::Mat3b drawModel(const ObjectModel& model) {
  const Points& rest = model.volume.rest_vertices;
  const Eigen::Isometry3d pose = cameraPose(rest);
  const Pinhole camera = makeCamera(transformed(rest, pose));
  const cv::Mat3b parts[] = {
      drawSurface(model.visual.rest_vertices, model.visual.triangles, pose, camera, {120, 190, 235}, false),
      drawSurface(rest, model.volume.surface, pose, camera, {225, 190, 140}, true),
      drawSurface(rest, farHalf(model.volume, pose), pose, camera, {150, 210, 150}, true)};
  cv::Mat3b picture;
  cv::hconcat(parts, 3, picture);
  return picture;
}

}  // namespace softbody
