#include "report/metrics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "report/units.h"
#include "softbody_common/images/pixel_labels.h"

namespace softbody::evaluation {
namespace {

void addLengths(const std::string& name, const Summary& s, std::vector<Metric>* metrics) {
  if (s.count == 0) return;
  metrics->push_back({name + ", mean", "mm", 1e3 * s.mean});
  metrics->push_back({name + ", RMS", "mm", 1e3 * s.rms});
  metrics->push_back({name + ", p95", "mm", 1e3 * s.p95});
  metrics->push_back({name + ", max", "mm", 1e3 * s.max});
}

void addStates(std::map<std::string, std::size_t> states, std::vector<Metric>* metrics) {
  states.try_emplace("tracking", 0);  // no such frame is a metric too
  double all = 0.0;
  for (const auto& [state, frames] : states) all += static_cast<double>(frames);
  for (const auto& [state, frames] : states)
    metrics->push_back({"frames " + state, "%", 100.0 * static_cast<double>(frames) / all});
}

void addVertexError(const VertexErrorReport& report, std::vector<Metric>* metrics) {
  addLengths("vertex error", report.all, metrics);
  addLengths("visible vertices", report.visible, metrics);
  addLengths("hidden vertices", report.hidden, metrics);
  addLengths("vertices near a cut", report.near_cut, metrics);
  for (std::size_t i = 0; i < report.pieces.size(); ++i)
    addLengths(fmt::format("piece {}", i), report.pieces[i], metrics);
  metrics->push_back({"drift, last - first seconds", "mm", 1e3 * report.drift_m});
  metrics->push_back({"drift, last / first seconds", "ratio", report.drift_ratio});
}

void addSurfaceDistance(const SurfaceDistanceReport& report, std::vector<Metric>* metrics) {
  addLengths("surface distance", report.all, metrics);
  addLengths("surface distance, visible", report.visible, metrics);
  addLengths("surface distance, hidden", report.hidden, metrics);
}

void addCalibration(const CalibrationReport& report, std::vector<Metric>* metrics) {
  metrics->push_back({"visible vertices within their 90 % bound", "%", 100.0 * report.within_visible});
  metrics->push_back({"hidden vertices within their 90 % bound", "%", 100.0 * report.within_hidden});
  metrics->push_back({"90 % bound over error, median", "ratio", report.median_ratio});
}

void addCut(const Report& report, std::vector<Metric>* metrics) {
  if (report.pieces) {
    metrics->push_back({"frames with the true number of pieces", "%", 100.0 * report.pieces->frames_right});
    metrics->push_back({"vertices in the right piece", "%", 100.0 * report.pieces->vertices_right});
  }
  if (report.cut_surface) {
    addLengths("cut surface from the true one", report.cut_surface->distance, metrics);
    addLengths("true cut surface from the result's one", report.cut_surface->missed, metrics);
    metrics->push_back({"cut surface, tilt", "deg", kDegrees * report.cut_surface->tilt_rad});
    metrics->push_back({"cut surface, local angle, mean", "deg", kDegrees * report.cut_surface->angle.mean});
  }
}

void addAbsences(const std::vector<Absence>& absences, std::vector<Metric>* metrics) {
  for (const Absence& absence : absences) {
    const std::string name = fmt::format("hidden at {:.1f} s", absence.begin_s);
    if (absence.covered.count > 0)
      metrics->push_back({name + ", hidden part, mean", "mm", 1e3 * absence.covered.mean});
    metrics->push_back({name + ", time until normal", "s", absence.recovery_s.value_or(kNothing)});
    metrics->push_back(
        {name + ", time until the error before", "s", absence.recovery_to_before_s.value_or(kNothing)});
  }
}

void addTool(const PoseErrorReport& tool, std::vector<Metric>* metrics) {
  const auto expected = static_cast<double>(tool.expected);
  metrics->push_back({"tool poses answered", "%", 100.0 * static_cast<double>(tool.answered) / expected});
  addLengths("tool position", tool.position, metrics);
  metrics->push_back({"tool rotation, mean", "deg", kDegrees * tool.rotation.mean});
  metrics->push_back({"tool rotation, p95", "deg", kDegrees * tool.rotation.p95});
}

void addLabels(const LabelReport& report, std::vector<Metric>* metrics) {
  metrics->push_back({"labels right", "%", 100.0 * report.right});
  for (std::size_t i = labels::kBackground; i < report.of_class.size(); ++i) {
    if (report.of_class[i])
      metrics->push_back(
          {fmt::format("labels right, {}", labels::kNames[i]), "%", 100.0 * *report.of_class[i]});
  }
}

void addForces(const ForceReport& report, std::vector<Metric>* metrics) {
  metrics->push_back({"force error, mean", "N", report.force_n.mean});
  metrics->push_back({"force error, p95", "N", report.force_n.p95});
  metrics->push_back({"forces within 10 % or 0.1 N", "%", 100.0 * report.right});
  if (report.place_m.count > 0) addLengths("place of the force", report.place_m, metrics);
  metrics->push_back({"forces within their 90 % bound", "%", 100.0 * report.within});
}

void addVolume(const VolumeReport& volume, std::vector<Metric>* metrics) {
  metrics->push_back({"volume change, mean", "%", 100.0 * volume.change.mean});
  metrics->push_back({"volume change, largest", "%", 100.0 * volume.change.largest});
  metrics->push_back({"volume change by cuts, at rest", "%", 100.0 * volume.cut_change});
  if (!volume.error) return;
  metrics->push_back({"volume error, mean", "%", 100.0 * volume.error->mean});
  metrics->push_back({"volume error, largest", "%", 100.0 * volume.error->largest});
}

std::string markdownCell(const std::optional<double>& value) {
  return value && !std::isnan(*value) ? fmt::format("{:.4f}", *value) : std::string("-");
}

}  // namespace

std::vector<Metric> metrics(const Report& report) {
  std::vector<Metric> all;
  const double expected = static_cast<double>(std::max<std::size_t>(1, report.frames.expected));
  all.push_back({"frames answered", "%", 100.0 * static_cast<double>(report.frames.answered) / expected});
  if (!report.states.empty()) addStates(report.states, &all);
  if (report.vertex_error) addVertexError(*report.vertex_error, &all);
  if (report.open_loop) addLengths("open loop", report.open_loop->all, &all);
  if (report.surface_distance) addSurfaceDistance(*report.surface_distance, &all);
  if (report.calibration) addCalibration(*report.calibration, &all);
  addCut(report, &all);
  addAbsences(report.absences, &all);
  if (report.jitter) all.push_back({"jitter while still, RMS", "mm", 1e3 * report.jitter->per_vertex.rms});
  if (report.tool) addTool(*report.tool, &all);
  if (report.labels) addLabels(*report.labels, &all);
  if (report.forces) addForces(*report.forces, &all);
  if (report.silhouette) {
    const std::string name =
        report.silhouette->against_truth ? "silhouette IoU" : "silhouette IoU against depth";
    all.push_back({name + ", mean", "", report.silhouette->mean});
    all.push_back({name + ", worst", "", report.silhouette->worst});
  }
  if (report.residual) {
    all.push_back({"depth residual, median", "mm", 1e3 * report.residual->residual.median});
    all.push_back({"depth residual, p95", "mm", 1e3 * report.residual->residual.p95});
    all.push_back({"depth within 15 mm, covered pixels are misses", "%",
                   100.0 * report.residual->within_15mm_of_measured});
  }
  if (report.volume.closed) addVolume(report.volume, &all);
  for (const auto& [name, s] : report.stages) {
    const std::string stage = name.node + ": " + name.stage + (name.initialization ? " (init.)" : "");
    all.push_back({stage + ", mean", "ms", s.mean});
    all.push_back({stage + ", p95", "ms", s.p95});
  }
  return all;
}

std::vector<ComparedMetric> tableRows(const Report& report) {
  std::vector<ComparedMetric> rows;
  for (const Metric& metric : metrics(report)) rows.push_back({metric.name, metric.unit, metric.value, {}});
  return rows;
}

std::vector<ComparedMetric> compare(const Report& first, const Report& second) {
  std::vector<ComparedMetric> rows = tableRows(first);
  for (const Metric& metric : metrics(second)) {
    const auto row = std::find_if(rows.begin(), rows.end(), [&](const ComparedMetric& compared) {
      return compared.name == metric.name;
    });
    if (row != rows.end()) {
      row->second = metric.value;
    } else {
      rows.push_back({metric.name, metric.unit, {}, metric.value});
    }
  }
  return rows;
}

nlohmann::json toJson(const std::vector<ComparedMetric>& comparison) {
  nlohmann::json rows = nlohmann::json::array();
  for (const ComparedMetric& row : comparison) {
    nlohmann::json entry = {{"figure", row.name}, {"unit", row.unit}};
    if (row.first) entry["result"] = *row.first;
    if (row.second) entry["other"] = *row.second;
    if (row.first && row.second) entry["difference"] = *row.first - *row.second;
    rows.push_back(entry);
  }
  return rows;
}

std::string toText(const std::vector<ComparedMetric>& comparison) {
  std::string text = fmt::format("{:<52} {:>12} {:>12} {:>12}\n", "", "result", "other", "difference");
  for (const ComparedMetric& row : comparison) {
    const std::string difference =
        row.first && row.second ? fmt::format("{:+.4f}", *row.first - *row.second) : std::string("-");
    text += fmt::format("{:<52} {:>12} {:>12} {:>12}\n",
                        row.name + (row.unit.empty() ? "" : " [" + row.unit + "]"), markdownCell(row.first),
                        markdownCell(row.second), difference);
  }
  return text;
}

}  // namespace softbody::evaluation
