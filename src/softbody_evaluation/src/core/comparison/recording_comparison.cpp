#include "comparison/recording_comparison.h"

#include <fmt/format.h>

#include <stdexcept>

#include "report/plots.h"
#include "softbody_common/time/time.h"

namespace softbody::evaluation {
namespace {

void plotResiduals(const std::vector<FrameResidual>& frames, Pictures* pictures) {
  std::vector<double> times, medians;
  std::vector<float> all;
  for (const FrameResidual& frame : frames) {
    if (frame.residuals.empty()) continue;
    times.push_back(seconds(frame.stamp - frames.front().stamp));
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

}  // namespace

RecordingComparison::RecordingComparison(const EvaluatorOptions& options, const SurfaceRecord& result,
                                         const SurfaceRecord* truth)
    : options_(options), result_(result), truth_(truth), film_(options, result, truth) {}

void RecordingComparison::add(const RecordedFrame& frame) {
  const int number = static_cast<int>(residuals_.size());
  residuals_.emplace_back();
  residuals_.back().stamp = frame.stamp;
  stamps_.insert(frame.stamp);
  const auto answer = result_.states.find(frame.stamp);
  if (answer == result_.states.end()) return;
  ++answered_;
  requireFrame(frame);
  const MeshState& state = answer->second;
  rasterize(frame.camera, state.vertices, topologyOf(result_, state).triangles, &raster_);
  if (!frame.depth.empty()) {
    residuals_.back() = depthResidual(raster_.depth, frame.depth, options_.occluder_m);
    residuals_.back().stamp = frame.stamp;
  }
  addSilhouette(frame);
  film_.add(frame, number, raster_.depth);
}

void RecordingComparison::finish(Report* report, Pictures* pictures) const {
  report->frames = {residuals_.size(), answered_, stamps_.size()};
  addResiduals(options_, residuals_, report);
  if (!silhouettes_.empty()) {
    report->silhouette = summarizeSilhouettes(silhouettes_, truth_ != nullptr);
    (*pictures)["silhouette.png"] = linePlot("silhouette IoU", "time [s]", silhouette_times_, silhouettes_);
  }
  plotResiduals(residuals_, pictures);
  (*pictures)["overlay.png"] = film_.sheet();
}

void RecordingComparison::requireFrame(const RecordedFrame& frame) const {
  if (frame.frame_id == result_.frame_id) return;
  throw std::invalid_argument(
      fmt::format("the recording is in frame '{}' but the truth and the result in '{}'", frame.frame_id,
                  result_.frame_id));
}

/// Draws the truth's surface. False if the truth has no state for this frame.
bool RecordingComparison::drawTruth(const RecordedFrame& frame) {
  const auto state = truth_->states.find(frame.stamp);
  if (state == truth_->states.end()) return false;
  rasterize(frame.camera, state->second.vertices, topologyOf(*truth_, state->second).triangles,
            &truth_raster_);
  return true;
}

void RecordingComparison::addSilhouette(const RecordedFrame& frame) {
  cv::Mat1b expected;
  if (truth_ != nullptr) {
    if (!drawTruth(frame)) return;
    expected = silhouette(truth_raster_.depth);
  } else if (!frame.depth.empty()) {
    expected = measuredSilhouette(frame.depth, raster_.depth, options_.occluder_m);
  } else {
    return;
  }
  silhouettes_.push_back(intersectionOverUnion(silhouette(raster_.depth), expected));
  silhouette_times_.push_back(seconds(frame.stamp - residuals_.front().stamp));
}

}  // namespace softbody::evaluation
