#include "report/model_report.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "report/units.h"

namespace softbody::evaluation {
namespace {

nlohmann::json distancesInMillimetres(const Summary& s) {
  return {{"samples", s.count},
          {"mean_mm", mm(s.mean)},
          {"p95_mm", mm(s.p95)},
          {"p99_mm", mm(s.p99)},
          {"max_mm", mm(s.max)}};
}

nlohmann::json partJson(const SurfaceAgreement& part) {
  return {{"share", part.share},
          {"scanned_to_true", distancesInMillimetres(part.to_truth)},
          {"true_to_scanned", distancesInMillimetres(part.to_scanned)},
          {"complete_within_1mm", part.within_1mm},
          {"complete_within_2mm", part.within_2mm}};
}

nlohmann::json volumeJson(const std::optional<double>& volume) {
  return volume ? nlohmann::json(1e6 * *volume) : nlohmann::json();
}

std::string number(double value, const char* unit) {
  return std::isnan(value) ? std::string("-") : fmt::format("{:.3f} {}", value, unit);
}

std::string distanceRow(const char* name, const Summary& s) {
  return fmt::format("  {:<34} {:>12} {:>12} {:>12} {:>12}\n", name, number(mm(s.mean), "mm"),
                     number(mm(s.p95), "mm"), number(mm(s.p99), "mm"), number(mm(s.max), "mm"));
}

std::string partText(const char* name, const SurfaceAgreement& part) {
  std::string text = fmt::format("{} ({:.1f} % of the scan)\n", name, 100.0 * part.share);
  text += distanceRow("scanned surface to true one", part.to_truth);
  text += distanceRow("true surface to scanned one", part.to_scanned);
  text += fmt::format("  {:<34} {:>12} {:>12}\n", "complete within 1 mm, 2 mm",
                      number(100.0 * part.within_1mm, "%"), number(100.0 * part.within_2mm, "%"));
  return text;
}

std::string volumeText(const char* name, const std::optional<double>& volume) {
  return fmt::format(
      "volume, {}: {}\n", name,
      volume ? fmt::format("{:.3f} ml", 1e6 * *volume) : std::string("not known, the surface is not closed"));
}

}  // namespace

std::string toText(const ModelReport& report) {
  std::string text = fmt::format("{:<36} {:>12} {:>12} {:>12} {:>12}\n", "", "mean", "95 %", "99 %", "max");
  text += partText("whole surface", report.whole);
  if (report.seen) text += partText("seen surface", *report.seen);
  if (report.unseen) text += partText("never seen", *report.unseen);
  text += volumeText("scanned", report.scanned_m3) + volumeText("true", report.true_m3);
  if (report.scanned_m3 && report.true_m3)
    text += fmt::format("volume, scanned over true: {:.4f}\n", *report.scanned_m3 / *report.true_m3);
  if (report.color.count > 0) {
    text += fmt::format(
        "colour difference: mean {:.2f}, 95 % {:.2f} of 255, after gains blue {:.3f}, green {:.3f}, red "
        "{:.3f}\n",
        report.color.mean, report.color.p95, report.gain[0], report.gain[1], report.gain[2]);
  }
  return text;
}

nlohmann::json toJson(const ModelReport& report) {
  nlohmann::json document = {{"whole", partJson(report.whole)},
                             {"scanned_ml", volumeJson(report.scanned_m3)},
                             {"true_ml", volumeJson(report.true_m3)}};
  if (report.scanned_m3 && report.true_m3) document["volume_ratio"] = *report.scanned_m3 / *report.true_m3;
  if (report.seen) document["seen"] = partJson(*report.seen);
  if (report.unseen) document["never_seen"] = partJson(*report.unseen);
  if (report.color.count > 0) {
    document["color"] = {{"samples", report.color.count},
                         {"mean_steps", report.color.mean},
                         {"p95_steps", report.color.p95},
                         {"gain_blue_green_red", {report.gain[0], report.gain[1], report.gain[2]}}};
  }
  const Eigen::Quaterniond q(report.T_true_scanned.linear());
  const Eigen::Vector3d& p = report.T_true_scanned.translation();
  document["pose_in_true_frame"] = {p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()};
  return document;
}

}  // namespace softbody::evaluation
