#include "softbody_bringup/evaluation/evaluator.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <set>
#include <stdexcept>

#include "softbody_bringup/evaluation/bags.h"
#include "softbody_bringup/evaluation/plots.h"
#include "softbody_bringup/virtual_camera/messages.h"
#include "softbody_common/rasterizer.h"
#include "softbody_common/topics.h"

namespace softbody::evaluation {
namespace {

constexpr int kOverlays = 12, kOverlayColumns = 4, kOverlayWidth = 640;

/// Pictures for the report, by file name.
using Pictures = std::map<std::string, cv::Mat3b>;

const MeshTopology& topologyOf(const SurfaceRecord& surface, const MeshState& state) {
  return surface.topologies.at(state.revision);
}

void requireFrame(const std::string& what, const std::string& frame_id, const SurfaceRecord& result) {
  if (frame_id == result.frame_id) return;
  throw std::invalid_argument(
      fmt::format("the {} is in frame '{}' but the result's surface in '{}'; run without output_frame", what,
                  frame_id, result.frame_id));
}

std::vector<FrameVertexError> vertexErrors(const SurfaceRecord& result, const SurfaceRecord& truth) {
  requireFrame("truth", truth.frame_id, result);
  std::vector<FrameVertexError> errors;
  for (const auto& [stamp, expected] : truth.states) {
    const auto answer = result.states.find(stamp);
    if (answer == result.states.end()) continue;
    const std::vector<int> matches = matchVertices(topologyOf(result, answer->second).vertex_parents,
                                                   topologyOf(truth, expected).vertex_parents);
    errors.push_back(vertexError(answer->second, expected, matches));
    errors.back().stamp = stamp;
  }
  return errors;
}

/// Stamps of about `count` states, evenly spread.
std::set<Nanoseconds> spread(const std::map<Nanoseconds, MeshState>& states, int count) {
  std::vector<Nanoseconds> stamps;
  for (const auto& [stamp, state] : states) stamps.push_back(stamp);
  std::set<Nanoseconds> chosen;
  for (int i = 0; i < count && !stamps.empty(); ++i) {
    chosen.insert(
        stamps[static_cast<std::size_t>(i) * (stamps.size() - 1) / static_cast<std::size_t>(count - 1)]);
  }
  return chosen;
}

cv::Mat3b overlay(const RecordedFrame& frame, const MeshState& state, const Triangles& triangles,
                  int number) {
  const double scale = static_cast<double>(kOverlayWidth) / frame.camera.width;
  cv::Mat3b picture;
  cv::resize(frame.color, picture, cv::Size(), scale, scale, scale < 1.0 ? cv::INTER_AREA : cv::INTER_LINEAR);
  Pinhole camera = frame.camera;
  camera.fx *= scale;
  camera.fy *= scale;
  camera.cx = (camera.cx + 0.5) * scale - 0.5;
  camera.cy = (camera.cy + 0.5) * scale - 0.5;
  drawWireframe(camera, state.vertices, triangles, &picture);
  cv::putText(picture, fmt::format("frame {}", number), cv::Point(8, 20), cv::FONT_HERSHEY_SIMPLEX, 0.55,
              cv::Scalar(255, 255, 255), 1, cv::LINE_AA);
  return picture;
}

/// The result against the recording, frame by frame.
struct RecordingComparison {
  std::size_t frames = 0;  ///< colour images of the recording
  std::size_t answered = 0;
  std::vector<FrameResidual>
      residuals;  ///< one a frame of the recording, empty where there is no answer or no depth
  std::vector<cv::Mat3b> overlays;
};

RecordingComparison compareWithRecording(const EvaluatorOptions& options, const std::string& recording,
                                         const SurfaceRecord& result) {
  RecordingComparison comparison;
  const std::set<Nanoseconds> shown = spread(result.states, options.report_folder.empty() ? 0 : kOverlays);
  RasterImage raster;
  readRecording(recording, options.camera, [&](const RecordedFrame& frame) {
    const int number = static_cast<int>(comparison.frames++);
    comparison.residuals.emplace_back();
    comparison.residuals.back().stamp = frame.stamp;
    const auto answer = result.states.find(frame.stamp);
    if (answer == result.states.end()) return;
    ++comparison.answered;
    requireFrame("recording", frame.frame_id, result);
    const MeshState& state = answer->second;
    const Triangles& triangles = topologyOf(result, state).triangles;
    if (!frame.depth.empty()) {
      rasterize(frame.camera, state.vertices, triangles, &raster);
      comparison.residuals.back() = depthResidual(raster.depth, frame.depth, options.occluder_m);
      comparison.residuals.back().stamp = frame.stamp;
    }
    if (shown.count(frame.stamp) != 0)
      comparison.overlays.push_back(overlay(frame, state, triangles, number));
  });
  return comparison;
}

std::vector<float> inMillimetres(std::vector<float> metres) {
  for (float& value : metres) value *= 1e3f;
  return metres;
}

void plotVertexErrors(const VertexErrorReport& report, const std::vector<FrameVertexError>& frames,
                      Pictures* pictures) {
  std::vector<double> means = report.frame_means;
  for (double& mean : means) mean *= 1e3;
  (*pictures)["vertex_error.png"] = linePlot("mean vertex error [mm]", "time [s]", report.times, means);
  std::vector<float> all;
  for (const FrameVertexError& frame : frames) {
    all.insert(all.end(), frame.visible.begin(), frame.visible.end());
    all.insert(all.end(), frame.hidden.begin(), frame.hidden.end());
  }
  (*pictures)["vertex_error_histogram.png"] =
      histogram("vertex error", "[mm]", inMillimetres(std::move(all)));
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
  (*pictures)["depth_residual_histogram.png"] =
      histogram("depth residual", "[mm]", inMillimetres(std::move(all)));
}

VolumeReport volumeOf(const SurfaceRecord& result) {
  const std::uint32_t revision = result.states.begin()->second.revision;
  std::vector<const MeshState*> states;
  for (const auto& [stamp, state] : result.states) {
    if (state.revision == revision) states.push_back(&state);
  }
  return volumeDrift(result.topologies.at(revision), states);
}

void addResiduals(const EvaluatorOptions& options, const std::vector<FrameResidual>& residuals,
                  Report* report) {
  const std::size_t window = static_cast<std::size_t>(options.window);
  for (std::size_t first = 0; first < residuals.size(); first += window) {
    report->residual_windows.push_back(summarize(residuals, first, window));
  }
  report->residual = summarize(residuals, 0, residuals.size());
}

void writeReport(const std::string& folder, const Report& report, const Pictures& pictures) {
  std::filesystem::create_directories(folder);
  const std::filesystem::path directory(folder);
  std::ofstream file(directory / "report.json");
  file << toJson(report).dump(2) << '\n';
  if (!file.flush())
    throw std::invalid_argument(fmt::format("{}: cannot be written", (directory / "report.json").string()));
  for (const auto& [name, picture] : pictures) {
    if (picture.empty()) continue;
    if (!cv::imwrite((directory / name).string(), picture)) {
      throw std::invalid_argument(fmt::format("{}: cannot be written", (directory / name).string()));
    }
  }
}

}  // namespace

Report evaluate(const EvaluatorOptions& options) {
  const SurfaceRecord result =
      readSurface(options.result, options.result_namespace + "/" + topics::kSurfaceTopology,
                  options.result_namespace + "/" + topics::kSurfaceState);
  Report report;
  Pictures pictures;
  report.frames = {result.states.size(), result.states.size()};
  report.volume = volumeOf(result);

  std::string recording = options.recording;
  if (recording.empty() && !options.truth.empty() && hasRecording(options.truth, options.camera))
    recording = options.truth;
  if (!recording.empty()) {
    const RecordingComparison comparison = compareWithRecording(options, recording, result);
    report.frames = {comparison.frames, comparison.answered};
    addResiduals(options, comparison.residuals, &report);
    plotResiduals(comparison.residuals, &pictures);
    pictures["overlay.png"] = contactSheet(comparison.overlays, kOverlayColumns);
  }
  if (!options.truth.empty()) {
    const SurfaceRecord truth =
        readSurface(options.truth, std::string("/") + virtual_camera::kTruthTopologyTopic,
                    std::string("/") + virtual_camera::kTruthStateTopic);
    const std::vector<FrameVertexError> errors = vertexErrors(result, truth);
    report.frames = {truth.states.size(), errors.size()};
    report.vertex_error = summarize(errors);
    plotVertexErrors(*report.vertex_error, errors, &pictures);
  }
  if (report.frames.answered == 0) {
    throw std::invalid_argument(fmt::format("{}: no surface has the stamp of a frame of {}", options.result,
                                            options.truth.empty() ? recording : options.truth));
  }
  if (!options.report_folder.empty()) writeReport(options.report_folder, report, pictures);
  return report;
}

}  // namespace softbody::evaluation
