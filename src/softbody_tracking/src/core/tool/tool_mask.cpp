#include "softbody_tracking/tool/tool_mask.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <opencv2/imgproc.hpp>

#include "softbody_common/geometry/rigid_fit.h"

namespace softbody {
namespace {

constexpr double kMargin = 0.008;      // [m] for the blade's thickness and its motion since its stamp
constexpr double kMinDistance = 0.01;  // [m] from the camera plane; nearer, the projection is ill-conditioned

/// A polygon in 3D: its plane, and its outline in that plane.
struct PlanePolygon {
  explicit PlanePolygon(const Points& corners) : origin(corners.colwise().mean().transpose()) {
    const Eigen::Index n = corners.rows();
    normal.setZero();
    for (Eigen::Index i = 0; i < n; ++i) {
      const Eigen::Vector3d a = corners.row(i), b = corners.row((i + 1) % n);
      normal += (a - origin).cross(b - origin);
    }
    normal.normalize();
    x = normal.unitOrthogonal();
    y = normal.cross(x);
    for (Eigen::Index i = 0; i < n; ++i) outline.push_back(inPlane(corners.row(i).transpose()));
  }
  cv::Point2f inPlane(const Eigen::Vector3d& p) const {
    return {static_cast<float>(x.dot(p - origin)), static_cast<float>(y.dot(p - origin))};
  }
  bool isNear(const Eigen::Vector3d& p) const {
    return std::abs(normal.dot(p - origin)) < kMargin &&
           cv::pointPolygonTest(outline, inPlane(p), true) > -kMargin;
  }

  Eigen::Vector3d origin, normal, x, y;
  std::vector<cv::Point2f> outline;
};

/// A polygon in the image, with a margin around it.
struct ImagePolygon {
  ImagePolygon(const Pinhole& camera, const Points& corners) {
    for (const auto& corner : corners.rowwise()) {
      const Eigen::Vector2d pixel = camera.project(corner.transpose());
      outline.emplace_back(static_cast<float>(pixel.x()), static_cast<float>(pixel.y()));
      margin = std::max(margin, kMargin * camera.fx / corner.z());
    }
  }
  bool contains(int u, int v) const {
    return cv::pointPolygonTest(outline, cv::Point2f(static_cast<float>(u), static_cast<float>(v)), true) >
           -margin;
  }
  /// Pixels of an image near the polygon, which may lie far outside of it.
  cv::Rect region(const cv::Size& image) const {
    const double border = std::ceil(margin) + 1.0;
    const auto within = [](double x, int size) { return static_cast<int>(std::clamp<double>(x, 0, size)); };
    cv::Point first(image.width, image.height), end;
    for (const cv::Point2f& p : outline) {
      const double u = std::floor(p.x), v = std::floor(p.y);
      first.x = std::min(first.x, within(u - border, image.width));
      first.y = std::min(first.y, within(v - border, image.height));
      end.x = std::max(end.x, within(u + 1.0 + border, image.width));
      end.y = std::max(end.y, within(v + 1.0 + border, image.height));
    }
    return {first, end};
  }

  std::vector<cv::Point2f> outline;  ///< [px]
  double margin = 0.0;               ///< [px]
};

}  // namespace

void ToolMask::setBlade(Nanoseconds stamp, const Points& blade) {
  stamp_ = stamp;
  blade_ = blade;
}

RgbdFrame ToolMask::withoutBlade(const RgbdFrame& frame) const {
  if (blade_.rows() < 3 || !blade_.allFinite() || std::abs(frame.stamp - stamp_) > kBladeValidity)
    return frame;
  const Points corners = transformed(blade_, frame.T_fixed_camera.inverse());
  if (corners.col(2).minCoeff() < kMinDistance) return frame;
  const PlanePolygon blade(corners);
  const ImagePolygon in_image(frame.camera, corners);
  const cv::Rect region = in_image.region(frame.depth.size());
  RgbdFrame result = frame;
  result.depth = frame.depth.clone();
  result.covered =
      frame.covered.empty() ? cv::Mat1b(frame.depth.size(), 0) : cv::Mat1b(frame.covered.clone());
  for (int v = region.y; v < region.br().y; ++v) {
    for (int u = region.x; u < region.br().x; ++u) {
      float& z = result.depth(v, u);
      const bool covered = z > 0.0f ? blade.isNear(frame.camera.unproject(u, v, z)) : in_image.contains(u, v);
      if (!covered) continue;
      z = 0.0f;
      result.covered(v, u) = 255;
    }
  }
  return result;
}

}  // namespace softbody
