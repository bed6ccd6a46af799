#include <fmt/format.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <set>
#include <stdexcept>

#include "ros/evaluation_comparisons.h"
#include "softbody_common/rasterizer.h"
#include "softbody_evaluation/report/plots.h"

namespace softbody::evaluation {
namespace {

constexpr int kOverlays = 12, kOverlayColumns = 4, kOverlayWidth = 640, kOverlayHeight = 480;
constexpr double kOverlayMargin = 0.15;  ///< around the body, of its extent

const MeshTopology& topologyOf(const SurfaceRecord& surface, const MeshState& state) {
  return surface.topologies.at(state.revision);
}

/// Stamps of about `count` states, evenly spread.
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

/// The part of the image in which the body is at any of the stamps; the whole one if it is in view at none.
cv::Rect viewOf(const Pinhole& camera, const std::map<Nanoseconds, MeshState>& states,
                const std::set<Nanoseconds>& stamps) {
  std::vector<cv::Point2f> pixels;
  for (const Nanoseconds stamp : stamps) {
    for (const auto& row : states.at(stamp).vertices.rowwise()) {
      if (row.z() < 0.01) continue;
      const Eigen::Vector2d pixel = camera.project(row.transpose());
      pixels.emplace_back(static_cast<float>(pixel.x()), static_cast<float>(pixel.y()));
    }
  }
  const cv::Rect image(0, 0, camera.width, camera.height);
  if (pixels.empty()) return image;
  const cv::Rect body = cv::boundingRect(pixels) & image;
  const cv::Point margin(static_cast<int>(kOverlayMargin * body.width),
                         static_cast<int>(kOverlayMargin * body.height));
  const cv::Rect view = cv::Rect(body.tl() - margin, body.br() + margin) & image;
  return body.empty() ? image : view;
}

cv::Mat3b overlay(const RecordedFrame& frame, const MeshState& state, const Triangles& triangles,
                  const cv::Rect& view, int number) {
  const double scale = std::min(static_cast<double>(kOverlayWidth) / view.width,
                                static_cast<double>(kOverlayHeight) / view.height);
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

void plotResiduals(const std::vector<FrameResidual>& frames, Pictures* pictures) {
  std::vector<double> times, medians;
  std::vector<float> all;
  for (const FrameResidual& frame : frames) {
    if (frame.residuals.empty()) continue;
    times.push_back(1e-9 * static_cast<double>(frame.stamp - frames.front().stamp));
    medians.push_back(1e3 * summarize(frame.residuals).median);
    all.insert(all.end(), frame.residuals.begin(), frame.residuals.end());
  }
  (*pictures)["depth_residual.png"] = linePlot("median depth residual [mm]", "time [s]", times, medians);
  (*pictures)["depth_residual_histogram.png"] = histogram("depth residual", "[mm]", all, 1e3);
}

void addResiduals(const EvaluatorOptions& options, const std::vector<FrameResidual>& residuals,
                  Report* report) {
  const std::size_t window = static_cast<std::size_t>(options.window);
  for (std::size_t first = 0; first < residuals.size(); first += window) {
    report->residual_windows.push_back(summarize(residuals, first, window));
  }
  report->residual = summarize(residuals, 0, residuals.size());
}

/// What is gathered frame by frame.
class Comparer {
 public:
  Comparer(const EvaluatorOptions& options, const SurfaceRecord& result, const SurfaceRecord* truth)
      : options_(options),
        result_(result),
        truth_(truth),
        shown_(spread(result.states, options.report_folder.empty() ? 0 : kOverlays)) {}

  void add(const RecordedFrame& frame) {
    const int number = static_cast<int>(residuals_.size());
    residuals_.emplace_back();
    residuals_.back().stamp = frame.stamp;
    stamps_.insert(frame.stamp);
    const auto answer = result_.states.find(frame.stamp);
    if (answer == result_.states.end()) return;
    ++answered_;
    requireFrame(frame);
    const MeshState& state = answer->second;
    const Triangles& triangles = topologyOf(result_, state).triangles;
    rasterize(frame.camera, state.vertices, triangles, &raster_);
    if (!frame.depth.empty()) {
      residuals_.back() = depthResidual(raster_.depth, frame.depth, options_.occluder_m);
      residuals_.back().stamp = frame.stamp;
    }
    addSilhouette(frame);
    if (shown_.count(frame.stamp) == 0) return;
    if (view_.empty()) view_ = viewOf(frame.camera, result_.states, shown_);
    overlays_.push_back(overlay(frame, state, triangles, view_, number));
  }

  void finish(Report* report, Pictures* pictures) const {
    report->frames = {residuals_.size(), answered_, stamps_.size()};
    addResiduals(options_, residuals_, report);
    if (!silhouettes_.empty()) {
      report->silhouette = summarizeSilhouettes(silhouettes_, truth_ != nullptr);
      (*pictures)["silhouette.png"] = linePlot("silhouette IoU", "time [s]", silhouette_times_, silhouettes_);
    }
    plotResiduals(residuals_, pictures);
    (*pictures)["overlay.png"] = contactSheet(overlays_, kOverlayColumns);
  }

 private:
  void requireFrame(const RecordedFrame& frame) const {
    if (frame.frame_id == result_.frame_id) return;
    throw std::invalid_argument(
        fmt::format("the recording is in frame '{}' but the truth and the result in '{}'", frame.frame_id,
                    result_.frame_id));
  }

  /// Against the truth's, or else against what is measured at the model's depth.
  void addSilhouette(const RecordedFrame& frame) {
    const cv::Mat1b mine = silhouette(raster_.depth);
    cv::Mat1b expected;
    if (truth_ != nullptr) {
      const auto state = truth_->states.find(frame.stamp);
      if (state == truth_->states.end()) return;
      rasterize(frame.camera, state->second.vertices, topologyOf(*truth_, state->second).triangles,
                &truth_raster_);
      expected = silhouette(truth_raster_.depth);
    } else if (!frame.depth.empty()) {
      expected = measuredSilhouette(frame.depth, raster_.depth, options_.occluder_m);
    } else {
      return;
    }
    silhouettes_.push_back(intersectionOverUnion(mine, expected));
    silhouette_times_.push_back(1e-9 * static_cast<double>(frame.stamp - residuals_.front().stamp));
  }

  const EvaluatorOptions& options_;
  const SurfaceRecord& result_;
  const SurfaceRecord* truth_;
  std::set<Nanoseconds> shown_, stamps_;  // of overlays; of all images
  RasterImage raster_, truth_raster_;
  std::size_t answered_ = 0;
  std::vector<FrameResidual>
      residuals_;  ///< one a frame of the recording, empty where there is no answer or no depth
  std::vector<double> silhouettes_, silhouette_times_;
  cv::Rect view_;  ///< of the overlays
  std::vector<cv::Mat3b> overlays_;
};

}  // namespace

void compareWithRecording(const EvaluatorOptions& options, const std::string& recording,
                          const SurfaceRecord& result, const SurfaceRecord* truth, Report* report,
                          Pictures* pictures) {
  Comparer comparer(options, result, truth);
  readRecording(recording, options.camera, [&](const RecordedFrame& frame) { comparer.add(frame); });
  comparer.finish(report, pictures);
}

}  // namespace softbody::evaluation
