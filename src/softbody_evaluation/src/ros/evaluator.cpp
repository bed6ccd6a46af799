#include "softbody_evaluation/ros/evaluator.h"

#include <fmt/format.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "comparison/material_maps.h"
#include "comparison/open_loop.h"
#include "comparison/recording_comparison.h"
#include "comparison/truth_comparison.h"
#include "report/html_page.h"
#include "report/metrics.h"
#include "report/report_folder.h"
#include "report/report_json.h"
#include "report/summary_text.h"
#include "ros/force_reader.h"
#include "ros/frame_change.h"
#include "ros/label_reader.h"
#include "ros/recording_reader.h"
#include "ros/result_reader.h"
#include "softbody_common/protocol/topics.h"
#include "softbody_common/protocol/tracking_state.h"
#include "softbody_evaluation/ros/surface_reader.h"

namespace softbody::evaluation {
namespace {

constexpr char kToolPose[] = "/tool/pose", kTrueToolPose[] = "/ground_truth/tool/pose";

/// A report with its pictures.
struct Measured {
  Report report;
  Nanoseconds end = std::numeric_limits<Nanoseconds>::max();  ///< of the tracked frames
  Pictures pictures;
  Film film;
};

std::string recordingOf(const EvaluatorOptions& options) {
  if (!options.recording.empty() || options.truth.empty() || !hasRecording(options.truth, options.camera))
    return options.recording;
  return options.truth;
}

SurfaceRecord readResult(const EvaluatorOptions& options, const std::string& bag) {
  return readSurface(bag, options.result_namespace + "/" + topics::kSurfaceTopology,
                     options.result_namespace + "/" + topics::kSurfaceState);
}

std::vector<StatusRecord> readStatusesOf(const EvaluatorOptions& options, const std::string& bag) {
  return readStatuses(bag, options.result_namespace + "/" + topics::kStatus);
}

SurfaceRecord readTruth(const EvaluatorOptions& options) {
  SurfaceRecord truth = readSurface(options.truth, options.truth_namespace + "/" + topics::kSurfaceTopology,
                                    options.truth_namespace + "/" + topics::kSurfaceState);
  if (!truth.notes.empty()) throw std::invalid_argument(truth.notes.front());
  return truth;
}

/// The bags that can have transforms. Those of the result come last and have priority.
std::vector<std::string> transformBags(const EvaluatorOptions& options, const std::string& recording) {
  std::vector<std::string> bags{recording.empty() ? options.truth : recording, options.result};
  if (bags.front() == bags.back()) bags.pop_back();
  return bags;
}

/// The surface in another frame: the surface itself, or a copy in `moved`.
const SurfaceRecord* inFrame(const std::string& frame_id, const std::vector<std::string>& bags,
                             const SurfaceRecord* surface, const std::string& states,
                             std::optional<SurfaceRecord>* moved) {
  if (surface == nullptr || surface->frame_id == frame_id) return surface;
  *moved = *surface;
  expressIn(frame_id, bags, &**moved, states);
  return &**moved;
}

/// Compares with the recording, in the camera's frame, which can move in the truth's frame.
void compareInCamera(const EvaluatorOptions& options, const std::string& recording,
                     const SurfaceRecord& result, const SurfaceRecord* truth, Measured* measured) {
  const std::string camera = recordingFrame(recording, options.camera);
  const std::vector<std::string> bags = transformBags(options, recording);
  std::optional<SurfaceRecord> moved_result, moved_truth;
  const SurfaceRecord* result_in_camera = inFrame(camera, bags, &result, "states", &moved_result);
  const SurfaceRecord* truth_in_camera = inFrame(camera, bags, truth, "states of the truth", &moved_truth);
  addNotes(result_in_camera->notes, &measured->report.notes);
  if (truth_in_camera != nullptr) addNotes(truth_in_camera->notes, &measured->report.notes);
  RecordingComparison comparison(options, *result_in_camera, truth_in_camera);
  readRecording(recording, options.camera, [&](const RecordedFrame& frame) {
    if (frame.stamp < measured->end) comparison.add(frame);
  });
  comparison.finish(&measured->report, &measured->pictures);
  measured->film = comparison.film();
}

VolumeReport volumeOf(const SurfaceRecord& surface) {
  std::vector<const MeshState*> states;
  for (const auto& [stamp, state] : surface.states) states.push_back(&state);
  return volumeDrift(surface.topologies, states);
}

/// The result for the same motion without occluders.
std::optional<SurfaceRecord> readUnhidden(const EvaluatorOptions& options, const std::string& recording,
                                          const SurfaceRecord& truth) {
  if (options.unhidden.empty()) return std::nullopt;
  EvaluatorOptions unhidden = options;
  unhidden.result = options.unhidden;
  SurfaceRecord result = readResult(unhidden, unhidden.result);
  expressIn(truth.frame_id, transformBags(unhidden, recording), &result, "states of the unhidden body");
  mapMaterial(unhidden.result, readStatusesOf(unhidden, unhidden.result), &truth, &result);
  return result;
}

void addTool(const EvaluatorOptions& options, const std::string& recording, Report* report) {
  const ToolRecord truth = readPoses(options.truth, kTrueToolPose);
  if (truth.poses.empty()) return;
  ToolRecord result = readPoses(options.result, options.result_namespace + kToolPose);
  expressIn(truth.frame_id, transformBags(options, recording), &result);
  addNotes(result.notes, &report->notes);
  report->tool = poseError(result.poses, truth.poses);
}

/// Measures the predicted states at the end, and takes them and their truth away.
void measureOpenLoop(const EvaluatorOptions& options, SurfaceRecord* result, SurfaceRecord* truth,
                     Measured* measured) {
  if (options.open_loop <= 0.0) return;
  if (truth == nullptr) throw std::invalid_argument("an open loop is measured against a truth: add --truth");
  measured->end = beginOfOpenLoop(*result, *truth, options.open_loop, options.result);
  const SurfaceRecord predicted = takeFrom(measured->end, result);
  measured->report.open_loop = compareOpenLoop(options, predicted, takeFrom(measured->end, truth));
}

Measured measure(const EvaluatorOptions& options) {
  SurfaceRecord result = readResult(options, options.result);
  Measured measured;
  Report& report = measured.report;
  const std::string recording = recordingOf(options);
  std::optional<SurfaceRecord> truth;
  if (!options.truth.empty()) truth = readTruth(options);
  if (truth) expressIn(truth->frame_id, transformBags(options, recording), &result);
  const std::vector<StatusRecord> statuses = readStatusesOf(options, options.result);
  report.alike = mapMaterial(options.result, statuses, truth ? &*truth : nullptr, &result);
  report.notes = result.notes;
  measureOpenLoop(options, &result, truth ? &*truth : nullptr, &measured);

  report.frames = {result.states.size(), result.states.size(), {}};
  report.volume = volumeOf(result);
  // A live status that comes without a new image repeats a stamp, or has none.
  for (const StatusRecord& status : statuses) {
    if (status.stamp > 0) report.state_of.emplace(status.stamp, nameOf(status.state));
  }
  for (const auto& [stamp, state] : report.state_of) ++report.states[state];
  report.stages = summarize(readStageTimes(options.result, options.result_namespace + "/" + topics::kTiming));
  if (!recording.empty()) compareInCamera(options, recording, result, truth ? &*truth : nullptr, &measured);
  if (truth) {
    const std::optional<SurfaceRecord> unhidden = readUnhidden(options, recording, *truth);
    if (unhidden) addNotes(unhidden->notes, &report.notes);
    compareWithTruth(options, result, *truth, unhidden ? &*unhidden : nullptr, &report, &measured.pictures);
    addTool(options, recording, &report);
    report.labels = compareLabels(options.result, options.result_namespace + "/" + topics::kLabels,
                                  options.truth, options.truth_namespace + "/" + topics::kLabels);
    report.forces = compareForces(options.result, options.result_namespace + "/" + topics::kForces,
                                  options.truth, options.truth_namespace + "/" + topics::kForces);
  }
  if (report.frames.answered == 0) {
    throw std::invalid_argument(fmt::format("{}: no surface has the stamp of a frame in {}", options.result,
                                            options.truth.empty() ? recording : options.truth));
  }
  return measured;
}

/// Adds the pictures of another result under other names.
void addOther(const Measured& other, Pictures* pictures) {
  for (const auto& [name, picture] : other.pictures) (*pictures)["other_" + name] = picture;
}

/// What the page says of a result. The captions of its film tell the tracker's state.
JudgedResult judged(const std::string& name, const Measured& measured) {
  JudgedResult result{name, judge(measured.report), measured.film};
  for (FilmFrame& frame : result.film) {
    const auto state = measured.report.state_of.find(frame.stamp);
    if (state != measured.report.state_of.end()) frame.caption += ", " + state->second;
  }
  return result;
}

}  // namespace

Report evaluate(const EvaluatorOptions& options) {
  const Measured measured = measure(options);
  if (!options.report_folder.empty()) {
    const std::string page = htmlPage({judged(options.result, measured)}, tableRows(measured.report),
                                      detailsText(measured.report), measured.pictures);
    writeReportFolder(options.report_folder, toJson(measured.report), page, measured.pictures);
  }
  return measured.report;
}

Comparison evaluateBoth(const EvaluatorOptions& options, const std::string& other_result) {
  EvaluatorOptions other_options = options;
  other_options.result = other_result;
  Measured first = measure(options);
  const Measured other = measure(other_options);
  addOther(other, &first.pictures);
  Comparison comparison{first.report, other.report};
  if (!options.report_folder.empty()) {
    const std::vector<ComparedMetric> rows = compare(first.report, other.report);
    const std::string text = options.result + "\n" + detailsText(first.report) + "\n" + other_result + "\n" +
                             detailsText(other.report);
    const std::string page =
        htmlPage({judged(options.result, first), judged(other_result, other)}, rows, text, first.pictures);
    writeReportFolder(options.report_folder, toJson(comparison), page, first.pictures);
  }
  return comparison;
}

nlohmann::json toJson(const Comparison& comparison) {
  return {{"result", toJson(comparison.first)},
          {"other", toJson(comparison.second)},
          {"figures", toJson(compare(comparison.first, comparison.second))}};
}

}  // namespace softbody::evaluation
