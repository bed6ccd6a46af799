#include "report/report_text.h"

#include <fmt/format.h>

#include <cmath>

#include "report/units.h"
#include "softbody_common/images/pixel_labels.h"

namespace softbody::evaluation {
namespace {

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
  std::string pieces;
  for (std::size_t i = 0; i < report.pieces.size(); ++i)
    pieces += row(fmt::format("piece {}", i).c_str(), report.pieces[i]);
  const std::string near_cut = report.near_cut.count > 0 ? row("near a cut", report.near_cut) : "";
  return fmt::format("vertex error [mm] {:>11} {:>9} {:>9} {:>9} {:>9} {:>9}\n", "count", "mean", "rms",
                     "median", "p95", "max") +
         row("all", report.all) + row("visible", report.visible) + row("hidden", report.hidden) + near_cut +
         pieces +
         fmt::format("  drift {:+.3f} mm from the first to the last {:.1f} s (ratio {:.2f}), {:+.4f} mm/s\n",
                     mm(report.drift_m), report.drift_window_s, report.drift_ratio, mm(report.drift_m_per_s));
}

std::string openLoopLine(const OpenLoopReport& report) {
  return fmt::format(
      "open loop: {} frames, {:.2f} s without images: vertex error {:.3f} mm mean, {:.3f} mm p95, {:.3f} mm "
      "max; {:.3f} mm mean in the last frame\n",
      report.frames, report.duration_s, mm(report.all.mean), mm(report.all.p95), mm(report.all.max),
      mm(report.last_mean));
}

std::string surfaceDistanceTable(const SurfaceDistanceReport& report) {
  return "distance from the true surface [mm]\n" + row("all", report.all) + row("visible", report.visible) +
         row("hidden", report.hidden);
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

std::string cutLines(const Report& report) {
  std::string text;
  if (report.pieces) {
    text += fmt::format(
        "pieces: {} at the end, {} are true; the right number in {:.1f} % of {} frames; {:.1f} % of the "
        "vertices "
        "in the right piece\n",
        report.pieces->result_pieces, report.pieces->true_pieces, 100.0 * report.pieces->frames_right,
        report.pieces->frames, 100.0 * report.pieces->vertices_right);
    if (report.pieces->delay_s)
      text += fmt::format("the last of them came {:.3f} s after the truth\n", *report.pieces->delay_s);
  }
  if (report.cut_surface && report.cut_surface->distance.count == 0) {
    text += "cut surface: the result has none\n";
  } else if (report.cut_surface) {
    const CutSurfaceReport& cut = *report.cut_surface;
    text += fmt::format(
        "cut surface: distance to the true one {:.3f} mm mean, {:.3f} mm max, and back {:.3f} mm max; "
        "tilt {:.2f} degrees, local angle {:.2f} degrees mean\n",
        mm(cut.distance.mean), mm(cut.distance.max), mm(cut.missed.max), kDegrees * cut.tilt_rad,
        kDegrees * cut.angle.mean);
  }
  return text;
}

std::string backAfter(const std::optional<double>& recovery_s, const std::string& what) {
  return recovery_s ? fmt::format("back to {} after {:.2f} s", what, *recovery_s) : "not back to " + what;
}

std::string absenceLine(const Absence& absence) {
  return fmt::format(
      "hidden from {:.2f} to {:.2f} s: {:.0f} % of the surface, mean error there {:.3f} mm; {}; {}\n",
      absence.begin_s, absence.end_s, 100.0 * absence.covered_share, mm(absence.covered.mean),
      backAfter(absence.recovery_s, fmt::format("normal ({:.3f} mm)", mm(absence.normal))),
      backAfter(absence.recovery_to_before_s, "the error before"));
}

std::string labelLine(const LabelReport& report) {
  std::string text = fmt::format("labels: {:.2f} % of {} pixels right, {:.2f} % unknown",
                                 100.0 * report.right, report.pixels, 100.0 * report.unknown);
  for (std::size_t i = labels::kBackground; i < report.of_class.size(); ++i) {
    if (report.of_class[i])
      text += fmt::format(", {} {:.2f} %", labels::kNames[i], 100.0 * *report.of_class[i]);
  }
  return text + fmt::format("; {} frames\n", report.frames);
}

std::string forceLine(const ForceReport& report) {
  const std::string place = report.place_m.count == 0
                                ? "never found"
                                : fmt::format("{:.1f} mm from its place (median)", mm(report.place_m.median));
  return fmt::format(
      "largest force: {:.3f} N mean error, {:.1f} % of {} frames within 10 % or 0.1 N, {}; {:.1f} % of all "
      "forces within the 90 % bound\n",
      report.force_n.mean, 100.0 * report.right, report.frames, place, 100.0 * report.within);
}

std::string optionalLines(const Report& report) {
  std::string text = cutLines(report);
  if (report.calibration) {
    text += fmt::format(
        "within the 90 % bound: {:.1f} % of the visible vertices, {:.1f} % of the hidden ones; bound "
        "over error {:.2f} median\n",
        100.0 * report.calibration->within_visible, 100.0 * report.calibration->within_hidden,
        report.calibration->median_ratio);
  }
  for (const Absence& absence : report.absences) text += absenceLine(absence);
  if (report.jitter) {
    text += fmt::format("jitter while still: {:.4f} mm RMS over {} frames, {:.4f} mm at the p95 vertex\n",
                        mm(report.jitter->per_vertex.rms), report.jitter->frames,
                        mm(report.jitter->per_vertex.p95));
  }
  if (report.tool) {
    text += fmt::format("tool: {} of {} poses, {:.3f} mm mean, {:.3f} mm p95, {:.3f} degrees mean\n",
                        report.tool->answered, report.tool->expected, mm(report.tool->position.mean),
                        mm(report.tool->position.p95), kDegrees * report.tool->rotation.mean);
  }
  if (report.labels) text += labelLine(*report.labels);
  if (report.forces) text += forceLine(*report.forces);
  if (report.silhouette) {
    text += fmt::format("silhouette IoU against {}: {:.4f} mean, {:.4f} worst of {} frames\n",
                        report.silhouette->against_truth ? "truth" : "measured depth",
                        report.silhouette->mean, report.silhouette->worst, report.silhouette->frames);
  }
  return report.stages.empty() ? text : text + stageTable(report.stages);
}

std::string volumeLine(const VolumeReport& volume) {
  if (!volume.closed) return "volume: unknown, because the surface is not closed\n";
  std::string text =
      fmt::format("volume: {:.1f} ml at rest, change {:+.3f} % mean, {:+.3f} % largest", 1e6 * volume.rest_m3,
                  100.0 * volume.change.mean, 100.0 * volume.change.largest);
  if (volume.error) {
    text += fmt::format("; error {:+.3f} % mean, {:+.3f} % largest", 100.0 * volume.error->mean,
                        100.0 * volume.error->largest);
  }
  return text + (volume.cut_change != 0.0
                     ? fmt::format("; cuts changed {:+.4f} % at rest\n", 100.0 * volume.cut_change)
                     : "\n");
}

}  // namespace

std::string residualTable(const Report& report) {
  if (!report.residual) return {};
  std::string text =
      fmt::format("depth residual\n  {:<11} {:>8} {:>10} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}\n",
                  "frames", "answered", "pixels", "median mm", "p95 mm", "<=10mm %", "<=15mm %", "strict %",
                  "occluded%", "no depth%");
  for (const ResidualReport& window : report.residual_windows) text += row(window);
  return text + row(*report.residual);
}

std::string toText(const Report& report) {
  std::string text = fmt::format("frames answered: {} of {}", report.frames.answered, report.frames.expected);
  for (const auto& [state, frames] : report.states) text += fmt::format(", {} {}", state, frames);
  text += "\n";
  if (report.vertex_error) text += vertexErrorTable(*report.vertex_error);
  if (report.open_loop) text += openLoopLine(*report.open_loop);
  if (report.surface_distance) text += surfaceDistanceTable(*report.surface_distance);
  text += residualTable(report) + optionalLines(report);
  for (const std::string& note : report.notes) text += "note: " + note + "\n";
  return text + volumeLine(report.volume);
}

}  // namespace softbody::evaluation
