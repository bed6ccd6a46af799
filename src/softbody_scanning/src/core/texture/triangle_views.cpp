#include "texture/triangle_views.h"

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "softbody_common/geometry/rigid_fit.h"
#include "softbody_common/images/rasterizer.h"
#include "texture/pixel_color.h"

namespace softbody::scanning {
namespace {

// Cosine of the angle between ray and normal. Below, a pixel covers five times its width: nothing is sharp.
constexpr double kSteepest = 0.2;
// Colour and depth of a camera are one to two pixels apart.
constexpr int kDepthWindow = 5;
// A steep surface changes its depth by so many widths of a pixel in this window.
constexpr double kSlope = 2.0 / kSteepest;

/// Nearest and farthest measured depth around each pixel [m]. Without depth: infinite and 0.
struct DepthBounds {
  cv::Mat1f nearest, farthest;
};

DepthBounds depthBounds(const cv::Mat1f& depth) {
  const cv::Mat window = cv::Mat::ones(kDepthWindow, kDepthWindow, CV_8U);
  cv::Mat1f known = depth.clone();
  known.setTo(std::numeric_limits<float>::max(), depth <= 0.0f);
  DepthBounds bounds;
  cv::erode(known, bounds.nearest, window);
  cv::dilate(depth, bounds.farthest, window);
  return bounds;
}

/// One frame, prepared for looking at vertices.
class FrameView {
 public:
  FrameView(const TriangleMesh& mesh, const KeyFrame& frame, double tolerance_m)
      : frame_(frame),
        tolerance_m_(tolerance_m),
        points_(transformed(mesh.vertices, frame.T_camera_model)),
        measured_(depthBounds(frame.depth)) {
    rasterize(frame.camera, points_, mesh.triangles, &raster_);
    for (Eigen::Index v = 0; v < points_.rows(); ++v) visible_.push_back(isVisible(v));
  }

  /// @return quality 0 if the frame does not see the triangle.
  TriangleView look(const Triangles& triangles, int t, int frame) const {
    TriangleView view;
    view.frame = frame;
    const auto corners = triangles.row(t);
    for (int k = 0; k < 3; ++k) {
      if (!visible_[static_cast<std::size_t>(corners[k])]) return view;
    }
    const Eigen::Vector3d a = points_.row(corners[0]), b = points_.row(corners[1]),
                          c = points_.row(corners[2]), middle = (a + b + c) / 3.0;
    const double cosine = -(b - a).cross(c - a).normalized().dot(middle.normalized());
    if (!(cosine >= kSteepest)) return view;
    const Eigen::Vector2d p = frame_.camera.project(a), q = frame_.camera.project(b),
                          r = frame_.camera.project(c), m = frame_.camera.project(middle);
    const double area = 0.5 * std::abs((q - p).x() * (r - p).y() - (q - p).y() * (r - p).x());
    view.quality = static_cast<float>(area * cosine * std::sqrt(std::max(1e-6, frame_.sharpness)));
    for (const Eigen::Vector2d& place : {p, q, r, m})
      view.color += 0.25f * colorAt(frame_.color, place.x(), place.y());
    return view;
  }

 private:
  bool isVisible(Eigen::Index v) const {
    const Eigen::Vector3d p = points_.row(v);
    if (!(p.z() > 0.0)) return false;
    const Eigen::Vector2d pixel = frame_.camera.project(p);
    // The picture also shows a little of what is beside the triangle.
    if (!(pixel.minCoeff() >= 2.0 && pixel.x() <= frame_.camera.width - 3.0 &&
          pixel.y() <= frame_.camera.height - 3.0))
      return false;
    const double slope = kSlope * p.z() / frame_.camera.fx, tolerance = tolerance_m_ + slope;
    const int x = static_cast<int>(std::lround(pixel.x())), y = static_cast<int>(std::lround(pixel.y()));
    if (measured_.nearest(y, x) < p.z() - tolerance || measured_.farthest(y, x) > p.z() + tolerance)
      return false;
    for (int i = -1; i <= 1; ++i) {
      for (int j = -1; j <= 1; ++j) {
        const float z = raster_.depth(y + i, x + j);
        if (z > 0.0f && z < p.z() - slope) return false;
      }
    }
    return true;
  }

  const KeyFrame& frame_;
  double tolerance_m_;
  Points points_;
  DepthBounds measured_;
  RasterImage raster_;
  std::vector<bool> visible_;
};

}  // namespace

TriangleViews findViews(const TriangleMesh& mesh, const std::vector<KeyFrame>& frames,
                        double depth_tolerance_m) {
  TriangleViews views(static_cast<std::size_t>(mesh.triangles.rows()));
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const FrameView frame(mesh, frames[i], depth_tolerance_m);
    for (int t = 0; t < mesh.triangles.rows(); ++t) {
      const TriangleView view = frame.look(mesh.triangles, t, static_cast<int>(i));
      if (view.quality > 0.0f) views[static_cast<std::size_t>(t)].push_back(view);
    }
  }
  return views;
}

}  // namespace softbody::scanning
