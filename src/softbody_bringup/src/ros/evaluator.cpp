#include "softbody_bringup/evaluation/evaluator.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "evaluation_comparisons.h"
#include "softbody_bringup/evaluation/plots.h"
#include "softbody_bringup/evaluation/report_folder.h"
#include "softbody_bringup/virtual_camera/messages.h"
#include "softbody_common/topics.h"

namespace softbody::evaluation {
namespace {

constexpr char kToolPose[] = "/tool/pose", kTrueToolPose[] = "/ground_truth/tool/pose";

/// A report with its pictures.
struct Measured {
  Report report;
  Pictures pictures;
};

std::string recordingOf(const EvaluatorOptions& options) {
  if (!options.recording.empty() || options.truth.empty() || !hasRecording(options.truth, options.camera))
    return options.recording;
  return options.truth;
}

SurfaceRecord readTruth(const EvaluatorOptions& options) {
  return readSurface(options.truth, std::string("/") + virtual_camera::kTruthTopologyTopic,
                     std::string("/") + virtual_camera::kTruthStateTopic);
}

/// Brings the result into the frame of what it is compared with.
void alignFrames(const EvaluatorOptions& options, const std::string& recording, const SurfaceRecord* truth,
                 SurfaceRecord* result, Report* report) {
  if (truth == nullptr && recording.empty()) return;
  const std::string frame_id = truth != nullptr ? truth->frame_id : recordingFrame(recording, options.camera);
  const std::string& other = recording.empty() ? options.truth : recording;
  // The result's own transforms come last and win.
  std::vector<std::string> bags{other, options.result};
  if (other == options.result) bags.pop_back();
  const std::size_t left_out = expressIn(frame_id, bags, result);
  if (left_out > 0) {
    report->notes.push_back(fmt::format(
        "{} states have no transform to '{}' at their stamp and were left out", left_out, frame_id));
  }
}

VolumeReport volumeOf(const SurfaceRecord& result) {
  const std::uint32_t revision = result.states.begin()->second.revision;
  std::vector<const MeshState*> states;
  for (const auto& [stamp, state] : result.states) {
    if (state.revision == revision) states.push_back(&state);
  }
  return volumeDrift(result.topologies.at(revision), states);
}

void addTool(const EvaluatorOptions& options, Report* report) {
  const PoseRecord truth = readPoses(options.truth, kTrueToolPose);
  if (!truth.empty())
    report->tool = poseError(readPoses(options.result, options.result_namespace + kToolPose), truth);
}

Measured measure(const EvaluatorOptions& options) {
  SurfaceRecord result =
      readSurface(options.result, options.result_namespace + "/" + topics::kSurfaceTopology,
                  options.result_namespace + "/" + topics::kSurfaceState);
  Measured measured;
  Report& report = measured.report;
  const std::string recording = recordingOf(options);
  std::optional<SurfaceRecord> truth;
  if (!options.truth.empty()) truth = readTruth(options);
  const SurfaceRecord* truth_or_null = truth ? &*truth : nullptr;
  alignFrames(options, recording, truth_or_null, &result, &report);

  report.frames = {result.states.size(), result.states.size()};
  report.volume = volumeOf(result);
  report.stages = summarize(readStageTimes(options.result, options.result_namespace + "/" + topics::kTiming));
  if (!recording.empty())
    compareWithRecording(options, recording, result, truth_or_null, &report, &measured.pictures);
  if (truth) {
    compareWithTruth(options, result, *truth, &report, &measured.pictures);
    addTool(options, &report);
  }
  if (report.frames.answered == 0) {
    throw std::invalid_argument(fmt::format("{}: no surface has the stamp of a frame of {}", options.result,
                                            options.truth.empty() ? recording : options.truth));
  }
  return measured;
}

/// Another result's figures and pictures under names of their own.
void addOther(const Measured& other, Pictures* pictures) {
  for (const auto& [name, picture] : other.pictures) (*pictures)["other_" + name] = picture;
}

}  // namespace

Report evaluate(const EvaluatorOptions& options) {
  const Measured measured = measure(options);
  if (!options.report_folder.empty()) {
    std::vector<ComparedFigure> rows;
    for (const Figure& figure : figures(measured.report))
      rows.push_back({figure.name, figure.unit, figure.value, {}});
    writeReportFolder(
        options.report_folder, toJson(measured.report),
        htmlPage("Evaluation of " + options.result, rows, toText(measured.report), measured.pictures),
        measured.pictures);
  }
  return measured.report;
}

Comparison evaluateBoth(const EvaluatorOptions& options, const std::string& other_result) {
  EvaluatorOptions other_options = options;
  other_options.result = other_result;
  Measured first = measure(options);
  const Measured other = measure(other_options);
  addOther(other, &first.pictures);
  const Comparison comparison{first.report, other.report};
  if (!options.report_folder.empty()) {
    const std::vector<ComparedFigure> rows = compare(first.report, other.report);
    const std::string words =
        options.result + "\n" + toText(first.report) + "\n" + other_result + "\n" + toText(other.report);
    writeReportFolder(options.report_folder, toJson(comparison),
                      htmlPage(options.result + " beside " + other_result, rows, words, first.pictures),
                      first.pictures);
  }
  return comparison;
}

nlohmann::json toJson(const Comparison& comparison) {
  return {{"result", toJson(comparison.first)},
          {"other", toJson(comparison.second)},
          {"figures", toJson(compare(comparison.first, comparison.second))}};
}

}  // namespace softbody::evaluation
