#include "softbody_bringup/evaluation/report.h"

#include <fmt/format.h>

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
  return {{"all", inMillimetres(report.all)},       {"visible", inMillimetres(report.visible)},
          {"hidden", inMillimetres(report.hidden)}, {"drift_mm_per_s", mm(report.drift_m_per_s)},
          {"frame_times_s", report.times},          {"frame_mean_mm", means}};
}

json toJson(const ResidualReport& report) {
  return {{"first_frame", report.first_frame},
          {"frames", report.frames},
          {"residual", inMillimetres(report.residual)},
          {"within_10mm", report.within_10mm},
          {"within_15mm", report.within_15mm},
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

std::string row(const char* name, const Summary& s) {
  return fmt::format("  {:<10} {:>10} {:>9.3f} {:>9.3f} {:>9.3f} {:>9.3f} {:>9.3f}\n", name, s.count,
                     mm(s.mean), mm(s.rms), mm(s.median), mm(s.p95), mm(s.max));
}

std::string row(const ResidualReport& r) {
  return fmt::format("  {:>5}-{:<5} {:>10} {:>9.2f} {:>9.2f} {:>9.1f} {:>9.1f} {:>9.1f} {:>9.1f}\n",
                     r.first_frame, r.first_frame + r.frames - (r.frames > 0), r.residual.count,
                     mm(r.residual.median), mm(r.residual.p95), 100.0 * r.within_10mm, 100.0 * r.within_15mm,
                     100.0 * r.occluded_share, 100.0 * r.without_depth_share);
}

std::string vertexErrorTable(const VertexErrorReport& report) {
  return fmt::format("vertex error [mm] {:>11} {:>9} {:>9} {:>9} {:>9} {:>9}\n", "count", "mean", "rms",
                     "median", "p95", "max") +
         row("all", report.all) + row("visible", report.visible) + row("hidden", report.hidden) +
         fmt::format("  drift {:+.4f} mm/s\n", mm(report.drift_m_per_s));
}

std::string residualTable(const Report& report) {
  std::string text =
      fmt::format("depth residual\n  {:<11} {:>10} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}\n", "frames", "pixels",
                  "median mm", "p95 mm", "<=10mm %", "<=15mm %", "occluded%", "no depth%");
  for (const ResidualReport& window : report.residual_windows) text += row(window);
  return text + row(*report.residual);
}

}  // namespace

json toJson(const Report& report) {
  json document = {{"frames", {{"expected", report.frames.expected}, {"answered", report.frames.answered}}},
                   {"volume", toJson(report.volume)}};
  if (report.vertex_error) document["vertex_error"] = toJson(*report.vertex_error);
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
  if (!report.volume.closed) return text + "volume: unknown, the surface is not closed\n";
  return text + fmt::format("volume: {:.1f} ml at rest, change {:+.3f} % on average, {:+.3f} % at most\n",
                            1e6 * report.volume.rest_m3, 100.0 * report.volume.mean_change,
                            100.0 * report.volume.largest_change);
}

}  // namespace softbody::evaluation
