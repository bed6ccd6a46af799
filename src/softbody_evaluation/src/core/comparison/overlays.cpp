#include "comparison/overlays.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <opencv2/imgproc.hpp>

#include "softbody_evaluation/report/plots.h"

namespace softbody::evaluation {
namespace {

constexpr int kColumns = 4, kWidth = 640, kHeight = 480;  // of the sheet; largest size of a picture [px]
constexpr double kMargin = 0.15;                          // around the body, of its extent
constexpr double kNearPlane_m = 0.01;

/// Up to `count` stamps at equal intervals.
std::set<Nanoseconds> spread(const std::map<Nanoseconds, MeshState>& states, int count) {
  std::vector<Nanoseconds> stamps;
  stamps.reserve(states.size());
  for (const auto& [stamp, state] : states) stamps.push_back(stamp);
  std::set<Nanoseconds> chosen;
  for (int i = 0; i < count && !stamps.empty(); ++i) {
    chosen.insert(
        stamps[static_cast<std::size_t>(i) * (stamps.size() - 1) / static_cast<std::size_t>(count - 1)]);
  }
  return chosen;
}

/// The part of the image that shows the body at all of the stamps. The whole image if the body is never in
/// view.
cv::Rect viewOf(const Pinhole& camera, const std::map<Nanoseconds, MeshState>& states,
                const std::set<Nanoseconds>& stamps) {
  std::vector<cv::Point2f> pixels;
  for (const Nanoseconds stamp : stamps) {
    for (const auto& row : states.at(stamp).vertices.rowwise()) {
      if (row.z() < kNearPlane_m) continue;
      const Eigen::Vector2d pixel = camera.project(row.transpose());
      pixels.emplace_back(static_cast<float>(pixel.x()), static_cast<float>(pixel.y()));
    }
  }
  const cv::Rect image(0, 0, camera.width, camera.height);
  if (pixels.empty()) return image;
  const cv::Rect body = cv::boundingRect(pixels) & image;
  const cv::Point margin(static_cast<int>(kMargin * body.width), static_cast<int>(kMargin * body.height));
  const cv::Rect view = cv::Rect(body.tl() - margin, body.br() + margin) & image;
  return body.empty() ? image : view;
}

cv::Mat3b overlay(const RecordedFrame& frame, const MeshState& state, const Triangles& triangles,
                  const cv::Rect& view, int number) {
  const double scale =
      std::min(static_cast<double>(kWidth) / view.width, static_cast<double>(kHeight) / view.height);
  cv::Mat3b picture;
  cv::resize(frame.color(view), picture, cv::Size(), scale, scale,
             scale < 1.0 ? cv::INTER_AREA : cv::INTER_LINEAR);
  Pinhole camera = frame.camera;
  camera.fx *= scale;
  camera.fy *= scale;
  camera.cx = (camera.cx - view.x + 0.5) * scale - 0.5;
  camera.cy = (camera.cy - view.y + 0.5) * scale - 0.5;
  drawWireframe(camera, state.vertices, triangles, &picture);
  cv::putText(picture, fmt::format("frame {}", number), cv::Point(8, 20), cv::FONT_HERSHEY_SIMPLEX, 0.55,
              cv::Scalar(255, 255, 255), 1, cv::LINE_AA);
  return picture;
}

}  // namespace

Overlays::Overlays(const SurfaceRecord& result, int count)
    : result_(result), chosen_(spread(result.states, count)) {}

void Overlays::add(const RecordedFrame& frame, int number) {
  if (chosen_.count(frame.stamp) == 0) return;
  if (view_.empty()) view_ = viewOf(frame.camera, result_.states, chosen_);
  const MeshState& state = result_.states.at(frame.stamp);
  pictures_.push_back(overlay(frame, state, topologyOf(result_, state).triangles, view_, number));
}

cv::Mat3b Overlays::sheet() const { return contactSheet(pictures_, kColumns); }

}  // namespace softbody::evaluation
