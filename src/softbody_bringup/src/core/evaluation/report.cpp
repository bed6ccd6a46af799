#include "softbody_bringup/evaluation/report.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace softbody::evaluation {
namespace {

using nlohmann::json;

double mm(double metres) { return 1e3 * metres; }

json inMillimetres(const Summary& s) {
  return {{"count", s.count},          {"mean_mm", mm(s.mean)}, {"rms_mm", mm(s.rms)},
          {"median_mm", mm(s.median)}, {"p95_mm", mm(s.p95)},   {"max_mm", mm(s.max)}};
}

json toJson(const VertexErrorReport& report) {
  json means = json::array();
  for (const double mean : report.frame_means) means.push_back(mm(mean));
  return {{"all", inMillimetres(report.all)},
          {"visible", inMillimetres(report.visible)},
          {"hidden", inMillimetres(report.hidden)},
          {"near_cut", inMillimetres(report.near_cut)},
          {"unmatched_share", report.unmatched_share},
          {"drift_mm_per_s", mm(report.drift_m_per_s)},
          {"drift_mm", mm(report.drift_m)},
          {"drift_window_s", report.drift_window_s},
          {"frame_times_s", report.times},
          {"frame_mean_mm", means}};
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
  return {{"closed", true},
          {"rest_ml", 1e6 * report.rest_m3},
          {"mean_change", report.mean_change},
          {"largest_change", report.largest_change}};
}

json toJson(const PiecesReport& report) {
  return {{"frames", report.frames},
          {"frames_right", report.frames_right},
          {"vertices_right", report.vertices_right},
          {"result_pieces", report.result_pieces},
          {"true_pieces", report.true_pieces}};
}

json toJson(const PoseErrorReport& report) {
  constexpr double kDegrees = 180.0 / M_PI;
  return {{"expected", report.expected},
          {"answered", report.answered},
          {"position", inMillimetres(report.position)},
          {"rotation_deg",
           {{"mean", kDegrees * report.rotation.mean},
            {"p95", kDegrees * report.rotation.p95},
            {"max", kDegrees * report.rotation.max}}}};
}

json toJson(const SilhouetteReport& report) {
  return {{"against", report.against_truth ? "truth" : "depth"},
          {"frames", report.frames},
          {"mean_iou", report.mean},
          {"worst_iou", report.worst}};
}

json toJson(const std::map<StageName, Summary>& stages) {
  json rows = json::array();
  for (const auto& [name, s] : stages) {
    rows.push_back({{"node", name.node},
                    {"stage", name.stage},
                    {"initialization", name.initialization},
                    {"count", s.count},
                    {"mean_ms", s.mean},
                    {"p95_ms", s.p95},
                    {"max_ms", s.max}});
  }
  return rows;
}

std::string row(const char* name, const Summary& s) {
  return fmt::format("  {:<10} {:>10} {:>9.3f} {:>9.3f} {:>9.3f} {:>9.3f} {:>9.3f}\n", name, s.count,
                     mm(s.mean), mm(s.rms), mm(s.median), mm(s.p95), mm(s.max));
}

std::string row(const ResidualReport& r) {
  return fmt::format(
      "  {:>5}-{:<5} {:>8} {:>10} {:>9.2f} {:>9.2f} {:>9.1f} {:>9.1f} {:>9.1f} {:>9.1f} {:>9.1f}\n",
      r.first_frame, r.first_frame + r.frames - (r.frames > 0), r.answered, r.residual.count,
      mm(r.residual.median), mm(r.residual.p95), 100.0 * r.within_10mm, 100.0 * r.within_15mm,
      100.0 * r.within_15mm_of_measured, 100.0 * r.occluded_share, 100.0 * r.without_depth_share);
}

std::string vertexErrorTable(const VertexErrorReport& report) {
  const std::string near_cut = report.near_cut.count > 0 ? row("near a cut", report.near_cut) : "";
  return fmt::format("vertex error [mm] {:>11} {:>9} {:>9} {:>9} {:>9} {:>9}\n", "count", "mean", "rms",
                     "median", "p95", "max") +
         row("all", report.all) + row("visible", report.visible) + row("hidden", report.hidden) + near_cut +
         fmt::format("  drift {:+.3f} mm from the first to the last {:.1f} s, {:+.4f} mm/s\n",
                     mm(report.drift_m), report.drift_window_s, mm(report.drift_m_per_s));
}

std::string residualTable(const Report& report) {
  std::string text =
      fmt::format("depth residual\n  {:<11} {:>8} {:>10} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}\n",
                  "frames", "answered", "pixels", "median mm", "p95 mm", "<=10mm %", "<=15mm %", "strict %",
                  "occluded%", "no depth%");
  for (const ResidualReport& window : report.residual_windows) text += row(window);
  return text + row(*report.residual);
}

std::string stageTable(const std::map<StageName, Summary>& stages) {
  std::string text =
      fmt::format("stage times [ms] {:>36} {:>9} {:>9} {:>9}\n", "count", "mean", "p95", "max");
  for (const auto& [name, s] : stages) {
    text += fmt::format("  {:<44} {:>6} {:>9.3f} {:>9.3f} {:>9.3f}\n",
                        name.node + ": " + name.stage + (name.initialization ? " (init.)" : ""), s.count,
                        s.mean, s.p95, s.max);
  }
  return text;
}

std::string optionalLines(const Report& report) {
  std::string text;
  if (report.pieces) {
    text += fmt::format(
        "pieces: {} of {} true ones at the end; as many as the truth in {:.1f} % of {} frames, {:.1f} % "
        "of the vertices in the right one\n",
        report.pieces->result_pieces, report.pieces->true_pieces, 100.0 * report.pieces->frames_right,
        report.pieces->frames, 100.0 * report.pieces->vertices_right);
  }
  if (report.jitter) {
    text += fmt::format("jitter while still: {:.4f} mm RMS over {} frames, {:.4f} mm at the p95 vertex\n",
                        mm(report.jitter->per_vertex.rms), report.jitter->frames,
                        mm(report.jitter->per_vertex.p95));
  }
  if (report.tool) {
    text += fmt::format("tool: {} of {} poses, {:.3f} mm mean, {:.3f} mm p95, {:.3f} degrees mean\n",
                        report.tool->answered, report.tool->expected, mm(report.tool->position.mean),
                        mm(report.tool->position.p95), report.tool->rotation.mean * 180.0 / M_PI);
  }
  if (report.silhouette) {
    text += fmt::format("silhouette IoU against {}: {:.4f} mean, {:.4f} worst of {} frames\n",
                        report.silhouette->against_truth ? "truth" : "measured depth",
                        report.silhouette->mean, report.silhouette->worst, report.silhouette->frames);
  }
  return report.stages.empty() ? text : text + stageTable(report.stages);
}

}  // namespace

json toJson(const Report& report) {
  json document = {{"frames", {{"expected", report.frames.expected}, {"answered", report.frames.answered}}},
                   {"volume", toJson(report.volume)}};
  if (report.vertex_error) document["vertex_error"] = toJson(*report.vertex_error);
  if (!report.notes.empty()) document["notes"] = report.notes;
  if (report.pieces) document["pieces"] = toJson(*report.pieces);
  if (report.jitter) {
    document["jitter"] = {{"frames", report.jitter->frames},
                          {"per_vertex", inMillimetres(report.jitter->per_vertex)}};
  }
  if (report.tool) document["tool"] = toJson(*report.tool);
  if (report.silhouette) document["silhouette"] = toJson(*report.silhouette);
  if (!report.stages.empty()) document["stages"] = toJson(report.stages);
  if (report.residual) {
    json windows = json::array();
    for (const ResidualReport& window : report.residual_windows) windows.push_back(toJson(window));
    document["depth_residual"] = {{"all", toJson(*report.residual)}, {"windows", windows}};
  }
  return document;
}

std::string toText(const Report& report) {
  std::string text =
      fmt::format("frames answered: {} of {}\n", report.frames.answered, report.frames.expected);
  if (report.vertex_error) text += vertexErrorTable(*report.vertex_error);
  if (report.residual) text += residualTable(report);
  text += optionalLines(report);
  for (const std::string& note : report.notes) text += "note: " + note + "\n";
  if (!report.volume.closed) return text + "volume: unknown, the surface is not closed\n";
  return text + fmt::format("volume: {:.1f} ml at rest, change {:+.3f} % on average, {:+.3f} % at most\n",
                            1e6 * report.volume.rest_m3, 100.0 * report.volume.mean_change,
                            100.0 * report.volume.largest_change);
}

}  // namespace softbody::evaluation
