#include "markerless/feature_tracks.h"

#include <opencv2/video/tracking.hpp>

namespace softbody::scanning {
namespace {

constexpr double kBack_px = 0.5;  // half a pixel off after the way back: another place

void flow(const TrackedFrame& from, const TrackedFrame& to, const std::vector<cv::Point2f>& start,
          std::vector<cv::Point2f>* end, std::vector<uchar>* found) {
  cv::calcOpticalFlowPyrLK(from.pyramid, to.pyramid, start, *end, *found, cv::noArray(), trackingWindow(),
                           kTrackingLevels, {cv::TermCriteria::EPS | cv::TermCriteria::COUNT, 20, 0.01},
                           cv::OPTFLOW_USE_INITIAL_FLOW);
}

double inverseDepthAt(const TrackedFrame& frame, const Eigen::Vector2d& pixel) {
  const int u = static_cast<int>(std::lround(pixel.x())), v = static_cast<int>(std::lround(pixel.y()));
  if (frame.plane.empty()) return frame.depth(v, u) > 0.0f ? 1.0 / frame.depth(v, u) : 0.0;
  const cv::Vec3f& N = frame.plane(v, u);
  const Eigen::Vector3d ray = frame.camera.unproject(pixel.x(), pixel.y(), 1.0);
  return N[0] * ray.x() + N[1] * ray.y() + N[2];
}

}  // namespace

std::vector<Sighting> trackAnchors(const TrackedFrame& from, const TrackedFrame& to,
                                   const Eigen::Isometry3d& T_to_from) {
  std::vector<int> used;
  std::vector<cv::Point2f> start, end, back;
  for (std::size_t i = 0; i < from.anchors.size(); ++i) {
    const Anchor& anchor = from.anchors[i];
    const Eigen::Vector3d p =
        T_to_from * from.camera.unproject(anchor.pixel.x, anchor.pixel.y, 1.0 / anchor.inverse_depth);
    if (!(p.z() > 0.05)) continue;
    const Eigen::Vector2d pixel = to.camera.project(p);
    if (!to.camera.contains(pixel.x(), pixel.y())) continue;
    used.push_back(static_cast<int>(i));
    start.push_back(anchor.pixel);
    end.emplace_back(static_cast<float>(pixel.x()), static_cast<float>(pixel.y()));
  }
  if (used.empty()) return {};
  std::vector<uchar> found, returned;
  flow(from, to, start, &end, &found);
  back = start;
  flow(to, from, end, &back, &returned);
  std::vector<Sighting> sightings;
  for (std::size_t k = 0; k < used.size(); ++k) {
    const Eigen::Vector2d pixel(end[k].x, end[k].y);
    if (!found[k] || !returned[k] || cv::norm(back[k] - start[k]) > kBack_px ||
        !to.camera.contains(pixel.x(), pixel.y()))
      continue;
    sightings.push_back({used[k],
                         {start[k].x, start[k].y},
                         from.anchors[used[k]].inverse_depth,
                         pixel,
                         inverseDepthAt(to, pixel)});
  }
  return sightings;
}

}  // namespace softbody::scanning
