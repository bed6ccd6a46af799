#include "softbody_scanning/fusion/depth_view.h"

#include <Eigen/Dense>
#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "fusion/plane_fits.h"
#include "softbody_common/statistics/median.h"

namespace softbody::scanning {
namespace {

constexpr double kEdgeSigmas = 3.0;  // scatter of a window that lies across an edge
constexpr double kSteepest_cos =
    0.17;                          // 80 degrees: beyond it depth says little about the place of a surface
constexpr int kSampleFrames = 20;  // for the noise

/// The nearest depth in a window; pixels without depth do not count.
cv::Mat1f nearestAround(const cv::Mat1f& depth) {
  cv::Mat1f far = depth.clone();
  far.setTo(1e9f, depth <= 0.0f);
  cv::Mat1f nearest;
  cv::erode(far, nearest, cv::Mat::ones(5, 5, CV_8U));
  nearest.setTo(0.0f, depth <= 0.0f);
  return nearest;
}

/// The plane through the measured point that is parallel to the fitted one.
cv::Vec3f tangentPlane(const Pinhole& camera, const cv::Vec3f& fit, int u, int v, float z) {
  const Eigen::Vector3d fitted(fit[0] * camera.fx, fit[1] * camera.fy,
                               fit[2] + fit[0] * (camera.cx - u) + fit[1] * (camera.cy - v));
  const Eigen::Vector3d point = camera.unproject(u, v, z);
  const double along = fitted.dot(point);
  if (!(along > kSteepest_cos * fitted.norm() * point.norm())) return cv::Vec3f::all(0);
  const Eigen::Vector3f plane = (fitted / along).cast<float>();
  return {plane.x(), plane.y(), plane.z()};
}

}  // namespace

double measureInverseDepthNoise(const std::vector<KeyFrame>& frames) {
  std::vector<float> scatters;
  const std::size_t step = std::max<std::size_t>(1, frames.size() / kSampleFrames);
  for (std::size_t i = 0; i < frames.size(); i += step) {
    const PlaneFits fits = fitPlanes(frames[i].depth);
    for (int row = 0; row < fits.scatter.rows; row += 4)
      for (int column = 0; column < fits.scatter.cols; column += 4)
        if (fits.scatter(row, column) > 0.0f) scatters.push_back(fits.scatter(row, column));
  }
  if (scatters.empty()) throw std::invalid_argument("no key frame has depth");
  return median(&scatters);
}

DepthView makeDepthView(const KeyFrame& frame, double inverse_depth_std) {
  const PlaneFits fits = fitPlanes(frame.depth);
  DepthView view{frame.camera, frame.T_camera_model, frame.depth, nearestAround(frame.depth),
                 cv::Mat3f(frame.depth.size(), cv::Vec3f::all(0))};
  for (int row = 0; row < frame.depth.rows; ++row) {
    for (int column = 0; column < frame.depth.cols; ++column) {
      const cv::Vec3f& fit = fits.coefficients(row, column);
      if (fit[2] > 0.0f && fits.scatter(row, column) < kEdgeSigmas * inverse_depth_std)
        view.plane(row, column) = tangentPlane(frame.camera, fit, column, row, frame.depth(row, column));
    }
  }
  return view;
}

}  // namespace softbody::scanning
