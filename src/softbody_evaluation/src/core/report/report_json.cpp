#include "report/report_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "report/units.h"
#include "report/verdict.h"
#include "softbody_common/images/pixel_labels.h"

namespace softbody::evaluation {
namespace {

using nlohmann::json;

json inMillimetres(const Summary& s) {
  return {{"count", s.count},          {"mean_mm", mm(s.mean)}, {"rms_mm", mm(s.rms)},
          {"median_mm", mm(s.median)}, {"p95_mm", mm(s.p95)},   {"max_mm", mm(s.max)}};
}

json allInMillimetres(const std::vector<double>& lengths) {
  json values = json::array();
  for (const double length : lengths) values.push_back(mm(length));
  return values;
}

json toJson(const CalibrationReport& report) {
  json bins = json::array();
  for (const CalibrationBin& bin : report.bins) {
    bins.push_back({{"count", bin.count},
                    {"predicted_rms_mm", mm(bin.predicted_rms)},
                    {"error_rms_mm", mm(bin.error_rms)}});
  }
  return {{"within_90_visible", report.within_visible},
          {"within_90_hidden", report.within_hidden},
          {"median_ratio", report.median_ratio},
          {"bins", bins}};
}

json toJson(const VertexErrorReport& report) {
  json pieces = json::array();
  for (const Summary& piece : report.pieces) pieces.push_back(inMillimetres(piece));
  return {{"all", inMillimetres(report.all)},
          {"visible", inMillimetres(report.visible)},
          {"hidden", inMillimetres(report.hidden)},
          {"near_cut", inMillimetres(report.near_cut)},
          {"pieces", pieces},
          {"unmatched_share", report.unmatched_share},
          {"drift_mm_per_s", mm(report.drift_m_per_s)},
          {"drift_mm", mm(report.drift_m)},
          {"drift_ratio", report.drift_ratio},
          {"drift_window_s", report.drift_window_s},
          {"first_time_s", report.first_time_s},
          {"frame_times_s", report.times},
          {"frame_mean_mm", allInMillimetres(report.frame_means)},
          {"frame_visible_mean_mm", allInMillimetres(report.frame_visible_means)},
          {"frame_visible_max_mm", allInMillimetres(report.frame_visible_largest)},
          {"frame_hidden_mean_mm", allInMillimetres(report.frame_hidden_means)},
          {"frame_covered_mean_mm", allInMillimetres(report.frame_covered_means)}};
}

json toJson(const OpenLoopReport& report) {
  return {{"frames", report.frames},
          {"duration_s", report.duration_s},
          {"all", inMillimetres(report.all)},
          {"last_mean_mm", mm(report.last_mean)}};
}

json toJson(const SurfaceDistanceReport& report) {
  return {{"all", inMillimetres(report.all)},
          {"visible", inMillimetres(report.visible)},
          {"hidden", inMillimetres(report.hidden)}};
}

json toJson(const ResidualReport& report) {
  return {{"first_frame", report.first_frame},
          {"frames", report.frames},
          {"residual", inMillimetres(report.residual)},
          {"within_10mm", report.within_10mm},
          {"within_15mm", report.within_15mm},
          {"within_15mm_of_measured", report.within_15mm_of_measured},
          {"answered", report.answered},
          {"occluded_share", report.occluded_share},
          {"without_depth_share", report.without_depth_share}};
}

json toJson(const VolumeReport& report) {
  if (!report.closed) return {{"closed", false}};
  json document = {{"closed", true},
                   {"rest_ml", 1e6 * report.rest_m3},
                   {"mean_change", report.change.mean},
                   {"largest_change", report.change.largest},
                   {"cut_change", report.cut_change}};
  if (report.error) {
    document["mean_error"] = report.error->mean;
    document["largest_error"] = report.error->largest;
  }
  return document;
}

json inDegrees(const Summary& s) {
  return {{"mean", kDegrees * s.mean}, {"p95", kDegrees * s.p95}, {"max", kDegrees * s.max}};
}

json toJson(const CutSurfaceReport& report) {
  return {{"distance", inMillimetres(report.distance)},
          {"missed", inMillimetres(report.missed)},
          {"angle_deg", inDegrees(report.angle)},
          {"tilt_deg", kDegrees * report.tilt_rad},
          {"area_ratio", report.area_ratio}};
}

json toJson(const Absence& absence) {
  json document = {{"begin_s", absence.begin_s},
                   {"end_s", absence.end_s},
                   {"covered_share", absence.covered_share},
                   {"normal_mm", mm(absence.normal)},
                   {"covered", inMillimetres(absence.covered)},
                   {"recovery_s", nullptr},
                   {"recovery_to_before_s", nullptr}};
  if (absence.recovery_s) document["recovery_s"] = *absence.recovery_s;
  if (absence.recovery_to_before_s) document["recovery_to_before_s"] = *absence.recovery_to_before_s;
  return document;
}

/// An array of the items' JSON.
template <typename Items>
json toJsonArray(const Items& items) {
  json array = json::array();
  for (const auto& item : items) array.push_back(toJson(item));
  return array;
}

json toJson(const PiecesReport& report) {
  json document = {{"frames", report.frames},
                   {"frames_right", report.frames_right},
                   {"vertices_right", report.vertices_right},
                   {"result_pieces", report.result_pieces},
                   {"true_pieces", report.true_pieces},
                   {"delay_s", nullptr}};
  if (report.delay_s) document["delay_s"] = *report.delay_s;
  return document;
}

json toJson(const PoseErrorReport& report) {
  return {{"expected", report.expected},
          {"answered", report.answered},
          {"position", inMillimetres(report.position)},
          {"rotation_deg", inDegrees(report.rotation)}};
}

json toJson(const LabelReport& report) {
  json document = {{"frames", report.frames},
                   {"pixels", report.pixels},
                   {"right", report.right},
                   {"unknown", report.unknown}};
  for (std::size_t i = labels::kBackground; i < report.of_class.size(); ++i) {
    json& share = document[labels::kNames[i]];  // null: no such pixel
    if (report.of_class[i]) share = *report.of_class[i];
  }
  return document;
}

json toJson(const ForceReport& report) {
  return {{"frames", report.frames}, {"mean_n", report.force_n.mean},          {"p95_n", report.force_n.p95},
          {"right", report.right},   {"place", inMillimetres(report.place_m)}, {"within_90", report.within}};
}

json toJson(const SilhouetteReport& report) {
  return {{"against", report.against_truth ? "truth" : "depth"},
          {"frames", report.frames},
          {"mean_iou", report.mean},
          {"worst_iou", report.worst}};
}

json toJson(const AlikePoses& alike) {
  json document = {{"poses", alike.poses}, {"same_shape", nullptr}, {"turn_deg", nullptr}};
  if (alike.compared) {
    document["same_shape"] = alike.same_shape;
    document["turn_deg"] = kDegrees * alike.turn_rad;
  }
  return document;
}

json toJson(const std::map<StageName, Summary>& stages) {
  json rows = json::array();
  for (const auto& [name, s] : stages) {
    rows.push_back({{"node", name.node},
                    {"stage", name.stage},
                    {"initialization", name.initialization},
                    {"count", s.count},
                    {"mean_ms", s.mean},
                    {"median_ms", s.median},
                    {"p95_ms", s.p95},
                    {"max_ms", s.max}});
  }
  return rows;
}

}  // namespace

json toJson(const Report& report) {
  json document = {{"frames", {{"expected", report.frames.expected}, {"answered", report.frames.answered}}},
                   {"verdict", toJson(judge(report))},
                   {"volume", toJson(report.volume)}};
  if (report.vertex_error) document["vertex_error"] = toJson(*report.vertex_error);
  if (report.open_loop) document["open_loop"] = toJson(*report.open_loop);
  if (report.surface_distance) document["surface_distance"] = toJson(*report.surface_distance);
  if (report.calibration) document["calibration"] = toJson(*report.calibration);
  if (!report.frame_states.empty()) document["frame_states"] = report.frame_states;
  if (!report.notes.empty()) document["notes"] = report.notes;
  if (!report.states.empty()) document["states"] = report.states;
  if (report.alike) document["alike"] = toJson(*report.alike);
  if (report.frames.recorded) document["frames"]["recorded"] = *report.frames.recorded;
  if (report.pieces) document["pieces"] = toJson(*report.pieces);
  if (report.cut_surface) document["cut_surface"] = toJson(*report.cut_surface);
  if (report.vertex_error) document["absences"] = toJsonArray(report.absences);
  if (report.jitter) {
    document["jitter"] = {{"frames", report.jitter->frames},
                          {"per_vertex", inMillimetres(report.jitter->per_vertex)}};
  }
  if (report.tool) document["tool"] = toJson(*report.tool);
  if (report.labels) document["labels"] = toJson(*report.labels);
  if (report.forces) document["forces"] = toJson(*report.forces);
  if (report.silhouette) document["silhouette"] = toJson(*report.silhouette);
  if (!report.stages.empty()) document["stages"] = toJson(report.stages);
  if (report.residual) {
    document["depth_residual"] = {{"all", toJson(*report.residual)},
                                  {"windows", toJsonArray(report.residual_windows)}};
  }
  return document;
}

}  // namespace softbody::evaluation
