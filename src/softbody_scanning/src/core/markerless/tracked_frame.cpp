#include "markerless/tracked_frame.h"

#include <Eigen/Dense>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

#include "fusion/plane_fits.h"
#include "markerless/feature_tracks.h"

namespace softbody::scanning {
namespace {

constexpr int kAnchors = 400;
constexpr double kQuality = 0.01;      // of the best corner: the robust estimate sorts the weak ones out
constexpr double kApart_px = 9.0;      // so that the windows share little
constexpr int kShading_px = 41;        // wider than a window of tracking
constexpr double kEdgeSigmas = 3.0;    // scatter of a window that lies across an edge
constexpr double kSteepest_cos = 0.3;  // beyond it a pixel says little about the place

/// Each pixel relative to the mean around it: exposure and white balance drift.
cv::Mat1b withoutExposure(const cv::Mat3b& color) {
  cv::Mat1b gray;
  cv::cvtColor(color, gray, cv::COLOR_BGR2GRAY);
  cv::Mat1f values, around;
  gray.convertTo(values, CV_32F, 1.0, 4.0);
  cv::boxFilter(values, around, CV_32F, cv::Size(kShading_px, kShading_px));
  cv::Mat1b relative;
  cv::Mat(values / around).convertTo(relative, CV_8U, 100.0);
  return relative;
}

Eigen::Vector3d planeOf(const Pinhole& camera, const cv::Vec3f& fit, int u, int v) {
  return {fit[0] * camera.fx, fit[1] * camera.fy,
          fit[2] + fit[0] * (camera.cx - u) + fit[1] * (camera.cy - v)};
}

cv::Mat3f planesOf(const TrackedFrame& frame, double inverse_depth_std) {
  const PlaneFits fits = fitPlanes(frame.depth);
  cv::Mat3f planes(frame.depth.size(), cv::Vec3f::all(0));
  for (int v = 0; v < planes.rows; ++v)
    for (int u = 0; u < planes.cols; ++u) {
      const cv::Vec3f& fit = fits.coefficients(v, u);
      if (!(fit[2] > 0.0f) || fits.scatter(v, u) > kEdgeSigmas * inverse_depth_std) continue;
      const Eigen::Vector3d N = planeOf(frame.camera, fit, u, v), ray = frame.camera.unproject(u, v, 1.0);
      if (N.dot(ray) < kSteepest_cos * N.norm() * ray.norm()) continue;
      planes(v, u) = {static_cast<float>(N.x()), static_cast<float>(N.y()), static_cast<float>(N.z())};
    }
  return planes;
}

}  // namespace

TrackedFrame followedFrame(const Pinhole& camera, const cv::Mat3b& color, const cv::Mat1f& depth) {
  TrackedFrame frame{camera, {}, depth, {}, {}};
  cv::buildOpticalFlowPyramid(withoutExposure(color), frame.pyramid, trackingWindow(), kTrackingLevels,
                              false);
  return frame;
}

void addAnchors(double inverse_depth_std, TrackedFrame* frame) {
  frame->plane = planesOf(*frame, inverse_depth_std);
  cv::Mat1b smooth(frame->depth.size(), 0);
  for (int v = 0; v < smooth.rows; ++v)
    for (int u = 0; u < smooth.cols; ++u) smooth(v, u) = frame->plane(v, u)[2] != 0.0f ? 255 : 0;
  std::vector<cv::Point2f> corners;
  cv::goodFeaturesToTrack(frame->pyramid[0], corners, kAnchors, kQuality, kApart_px, smooth, 5);
  if (!corners.empty())
    cv::cornerSubPix(frame->pyramid[0], corners, {2, 2}, {-1, -1},
                     {cv::TermCriteria::EPS | cv::TermCriteria::COUNT, 10, 0.02});
  for (const cv::Point2f& pixel : corners) {
    const int u = cvRound(pixel.x), v = cvRound(pixel.y);
    if (u < 0 || v < 0 || u >= smooth.cols || v >= smooth.rows || smooth(v, u) == 0) continue;
    const cv::Vec3f& N = frame->plane(v, u);
    const Eigen::Vector3d ray = frame->camera.unproject(pixel.x, pixel.y, 1.0);
    frame->anchors.push_back({pixel, N[0] * ray.x() + N[1] * ray.y() + N[2]});
  }
}

}  // namespace softbody::scanning
