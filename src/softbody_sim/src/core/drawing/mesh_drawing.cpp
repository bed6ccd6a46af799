#include "softbody_sim/drawing/mesh_drawing.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "softbody_common/geometry/rigid_fit.h"
#include "softbody_common/images/rasterizer.h"
#include "surface_mesh/surface_repair.h"

namespace softbody {
namespace {

constexpr int kOversampling = 2;       ///< factor by which the picture is drawn larger, then averaged
constexpr double kDistance = 4.0;      ///< of the camera from the middle, over the size of the mesh
constexpr double kEdgeWidth_px = 1.6;  ///< half width of a drawn edge, oversampled
constexpr double kFullInk_px = 16.0;   ///< triangle height from which edges are drawn in full, oversampled
constexpr int kLineWidth_px = 5;       ///< oversampled
constexpr double kBehind = 0.004;      ///< relative depth by which a line may lie behind the surface
constexpr double kInside = 0.3;        ///< brightness of back faces
constexpr double kInk = 0.25;          ///< brightness of edges

/// Rest frame in the frame of a camera that looks at the middle.
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

/// The camera of a picture enlarged by a factor.
Pinhole enlarged(Pinhole camera, int factor) {
  camera.width *= factor;
  camera.height *= factor;
  camera.fx *= factor;
  camera.fy *= factor;
  camera.cx = (camera.cx + 0.5) * factor - 0.5;
  camera.cy = (camera.cy + 0.5) * factor - 0.5;
  return camera;
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

/// One triangle as the camera sees it.
struct SeenTriangle {
  SeenTriangle(const Points& seen, const Triangles& triangles, int f, const Pinhole& camera) {
    Eigen::Vector3d p[3];
    for (int k = 0; k < 3; ++k) {
      p[k] = seen.row(triangles(f, k));
      corners[k] = camera.project(p[k]);
    }
    const Eigen::Vector2d a = corners[1] - corners[0], b = corners[2] - corners[0];
    const double longest = std::max({a.norm(), b.norm(), (b - a).norm(), 1e-9});
    const double height = std::abs(a.x() * b.y() - a.y() * b.x()) / longest;
    ink = std::min(1.0, height / kFullInk_px);
    static const Eigen::Vector3d light = Eigen::Vector3d(-0.4, -0.7, -1.0).normalized();
    const Eigen::Vector3d normal = (p[1] - p[0]).cross(p[2] - p[0]).normalized();
    brightness = normal.dot(p[0]) > 0.0 ? kInside : 0.45 + 0.55 * std::max(0.0, normal.dot(light));
  }
  double at(const Eigen::Vector2d& pixel, bool edges) const {
    if (!edges || distanceToEdge(corners, pixel) > kEdgeWidth_px) return brightness;
    return brightness + ink * (kInk - brightness);
  }

  Eigen::Vector2d corners[3];
  double brightness;
  double ink;  ///< opacity of its edges, 0 to 1: lower in fine meshes
};

/// Whether a vertex is visible, with a tolerance in depth.
bool isSeen(const Eigen::Vector3d& p, const Pinhole& camera, const cv::Mat1f& depth) {
  const Eigen::Vector2d pixel = camera.project(p);
  if (!camera.contains(pixel.x(), pixel.y())) return false;
  const float before =
      depth(static_cast<int>(std::lround(pixel.y())), static_cast<int>(std::lround(pixel.x())));
  return before == 0.0f || p.z() < (1.0 + kBehind) * before;
}

void drawLines(const Points& seen, const MeshPaint& paint, const Pinhole& camera, const cv::Mat1f& depth,
               cv::Mat3b* image) {
  for (const auto& line : paint.lines.rowwise()) {
    cv::Point2d ends[2];
    bool all_seen = true;
    for (int k = 0; k < 2; ++k) {
      const Eigen::Vector3d p = seen.row(line[k]);
      all_seen = all_seen && isSeen(p, camera, depth);
      const Eigen::Vector2d pixel = camera.project(p);
      ends[k] = {pixel.x(), pixel.y()};
    }
    if (all_seen) cv::line(*image, ends[0], ends[1], paint.line_color, kLineWidth_px, cv::LINE_AA);
  }
}

}  // namespace

View viewOf(const Points& points, const cv::Size& size) {
  View view;
  view.T_camera_mesh = cameraPose(points);
  const Points seen = transformed(points, view.T_camera_mesh);
  const double right = seen.col(0).cwiseQuotient(seen.col(2)).cwiseAbs().maxCoeff();
  const double down = seen.col(1).cwiseQuotient(seen.col(2)).cwiseAbs().maxCoeff();
  const double focal = 0.47 * std::min(size.width / right, size.height / down);
  view.camera = {size.width, size.height, focal, focal, 0.5 * (size.width - 1), 0.5 * (size.height - 1)};
  return view;
}

cv::Mat3b drawMesh(const Points& vertices, const Triangles& triangles, const MeshPaint& paint,
                   const View& view) {
  const Points seen = transformed(vertices, view.T_camera_mesh);
  const Pinhole camera = enlarged(view.camera, kOversampling);
  RasterImage raster;
  rasterize(camera, seen, triangles, &raster);
  cv::Mat3b image(camera.height, camera.width, cv::Vec3b(255, 255, 255));
  for (int v = 0; v < image.rows; ++v) {
    for (int u = 0; u < image.cols; ++u) {
      const int f = raster.triangle(v, u);
      if (f < 0) continue;
      const std::size_t color = paint.colors.size() == 1 ? 0 : static_cast<std::size_t>(f);
      image(v, u) =
          cv::Vec3b(SeenTriangle(seen, triangles, f, camera).at({u, v}, paint.edges) * paint.colors[color]);
    }
  }
  drawLines(seen, paint, camera, raster.depth, &image);
  cv::resize(image, image, {view.camera.width, view.camera.height}, 0.0, 0.0, cv::INTER_AREA);
  return image;
}

}  // namespace softbody
