#include "report/summary_text.h"

#include <fmt/format.h>

#include <cmath>
#include <set>
#include <sstream>

#include "report/units.h"
#include "report/verdict.h"

namespace softbody::evaluation {
namespace {

constexpr std::size_t kWidth = 100;  // about that of the table
// Metrics without limits that are asked for.
const std::set<std::string> kAskedFor = {"vertex error, mean", "open loop, mean", "open loop, p95"};

std::string line(const std::string& name, const std::string& value, const std::string& unit,
                 const std::string& rest) {
  std::string text = fmt::format("  {:<50} {:>8} {:<5} {}", name, value, unit, rest);
  return text.erase(text.find_last_not_of(' ') + 1) + "\n";
}

std::string row(const Metric& metric) {
  const std::string value = std::isnan(metric.value) ? "-" : fmt::format("{:.4g}", metric.value);
  const Level level = levelOf(metric.name, metric.value);
  const std::string mark = level == Level::kGood ? "" : fmt::format("   <- {}", toText(level));
  return line(metric.name, value, metric.unit, limitsOf(metric.name) + mark);
}

std::string row(const ResidualReport& r) {
  return fmt::format(
      "  {:>5}-{:<5} {:>8} {:>10} {:>9.2f} {:>9.2f} {:>9.1f} {:>9.1f} {:>9.1f} {:>9.1f} {:>9.1f}\n",
      r.first_frame, r.first_frame + r.frames - (r.frames > 0), r.answered, r.residual.count,
      mm(r.residual.median), mm(r.residual.p95), 100.0 * r.within_10mm, 100.0 * r.within_15mm,
      100.0 * r.within_15mm_of_measured, 100.0 * r.occluded_share, 100.0 * r.without_depth_share);
}

/// Lines of at most kWidth characters. @param bullet before the first one; the others are as far inside.
std::string paragraph(const std::string& bullet, const std::string& words) {
  std::string text, line = bullet;
  const std::string indent(bullet.size(), ' ');
  std::istringstream stream(words);
  for (std::string word; stream >> word;) {
    if (line.size() > bullet.size() && line.size() + 1 + word.size() > kWidth) {
      text += line + "\n";
      line = indent;
    }
    line += (line.size() > bullet.size() ? " " : "") + word;
  }
  return text + line + "\n";
}

}  // namespace

std::string verdictText(const Report& report) {
  const Verdict verdict = judge(report);
  std::string text = "verdict: " + toText(verdict.level) + "\n";
  if (!verdict.premise.empty()) text += paragraph("  ", verdict.premise);
  for (const Finding& finding : verdict.findings) text += paragraph("  - ", finding.sentence);
  for (const std::string& limit : verdict.limits) text += paragraph("  ", limit);
  for (const std::string& note : report.notes) text += paragraph("  note: ", note);
  return text;
}

std::string summaryTable(const Report& report) {
  std::string text = line("metric", "result", "", "limits");
  for (const Metric& metric : metrics(report)) {
    if (kAskedFor.count(metric.name) > 0 || !limitsOf(metric.name).empty()) text += row(metric);
  }
  return text;
}

std::string residualTable(const Report& report) {
  if (!report.residual) return {};
  std::string text =
      fmt::format("depth residual\n  {:<11} {:>8} {:>10} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}\n",
                  "frames", "answered", "pixels", "median mm", "p95 mm", "<=10mm %", "<=15mm %", "strict %",
                  "occluded%", "no depth%");
  for (const ResidualReport& window : report.residual_windows) text += row(window);
  return text + row(*report.residual);
}

std::string detailsText(const Report& report) {
  std::string text = residualTable(report);
  for (const std::string& note : report.notes) text += "note: " + note + "\n";
  return text;
}

}  // namespace softbody::evaluation
